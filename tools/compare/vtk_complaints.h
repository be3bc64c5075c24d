// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pds
{

/** \brief While it lives, what VTK complains of is kept here instead of being printed. VTK goes on after a complaint,
 * so look at first() before its results are used. */
class VtkComplaints
{
 public:
  VtkComplaints();
  ~VtkComplaints();
  VtkComplaints(const VtkComplaints&) = delete;
  VtkComplaints& operator=(const VtkComplaints&) = delete;

  /** \brief The first complaint in one line; empty if there was none. */
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  std::string first_;
};

}  // namespace pds

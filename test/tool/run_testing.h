// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "temporary_directory.h"

#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace pds
{

/** \brief Starts the program in a directory of its own. */
class RunTool : public TemporaryDirectory
{
 protected:
  /** \brief Runs it in the directory. \return its exit status, or -1 if a signal ended it */
  int run(const std::string& arguments, const std::string& before = "")
  {
    const std::string command =
        "cd '" + path("") + "' && " + before + " '" TOOL "' " + arguments + " >.log.out 2>.log.err";
    const int status = std::system(command.c_str());
    output_ = take(".log.out");
    errors_ = take(".log.err");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] const std::string& output() const { return output_; }  ///< stdout of the last run
  [[nodiscard]] const std::string& errors() const { return errors_; }  ///< stderr of the last run

  /** \brief Whether the last run failed as promised: one line that starts with the program's name and holds \a part. */
  [[nodiscard]] testing::AssertionResult complained_of(const std::string& part) const
  {
    const std::string program = std::filesystem::path(TOOL).filename().string() + ": ";
    const bool is_one_line = !errors_.empty() && errors_.find('\n') == errors_.size() - 1;
    if (output_.empty() && is_one_line && errors_.rfind(program, 0) == 0 && errors_.find(part) != std::string::npos) {
      return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "stdout: " << output_ << "\nstderr: " << errors_;
  }

 private:
  std::string take(const std::string& name)
  {
    const std::string text = read(name);
    std::filesystem::remove(path(name));
    return text;
  }

  std::string output_;
  std::string errors_;
};

/** \brief Rows "x y z" of random points on a sphere with all their digits, \a suffix at the end of each. */
inline std::string sphere_rows(
    std::size_t count, double radius, double center_x, double center_y, const char* suffix = "")
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::string rows;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = normal(random);
    const double y = normal(random);
    const double z = normal(random);
    const double scale = radius / std::hypot(x, y, z);
    char row[128];
    std::snprintf(row, sizeof row, "%.17g %.17g %.17g%s\n", center_x + scale * x, center_y + scale * y, scale * z,
                  suffix);
    rows += row;
  }
  return rows;
}

}  // namespace pds

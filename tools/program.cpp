// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include <pcl_pds_recon/options.h>

#include <iostream>
#include <new>

namespace pds
{

namespace
{

constexpr int exit_bad_data = 1;
constexpr int exit_bad_usage = 2;

int fail(int status, const std::string& name, const std::string& message)
{
  std::cerr << name << ": " << message << std::endl;
  return status;
}

}  // namespace

int run_program(const std::string& name, const std::function<int()>& body)
{
  try {
    return body();
  } catch (const UsageError& error) {
    return fail(exit_bad_usage, name, error.what());
  } catch (const InvalidOption& error) {
    return fail(exit_bad_usage, name, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_bad_data, name, "not enough memory for this input; thin it out or use a larger machine");
  } catch (const std::exception& error) {
    return fail(exit_bad_data, name, error.what());
  }
}

}  // namespace pds

// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include "printable.h"

#include <pcl_pds_recon/options.h>

#include <fcntl.h>
#include <unistd.h>

#include <iostream>
#include <new>
#include <utility>

namespace pds
{

namespace
{

constexpr int exit_bad_data = 1;
constexpr int exit_bad_usage = 2;

int fail(int status, const std::string& name, const std::string& message)
{
  std::cerr << printable(name + ": " + message) << std::endl;
  return status;
}

/** Whoever starts the program may have closed them. A file that is opened in the place of one would get what is meant
 * for it; these can neither be read nor written, like a closed one. */
void occupy_closed_standard_streams()
{
  for (const auto& [stream, mode] :
       {std::pair(STDIN_FILENO, O_WRONLY), std::pair(STDOUT_FILENO, O_RDONLY), std::pair(STDERR_FILENO, O_RDONLY)}) {
    if (fcntl(stream, F_GETFD) == -1) {
      static_cast<void>(open("/dev/null", mode));  // the lowest free number, which is this one
    }
  }
}

}  // namespace

int run_program(const std::string& name, const std::function<int()>& body)
{
  occupy_closed_standard_streams();
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

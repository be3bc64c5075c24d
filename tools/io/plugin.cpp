// SPDX-License-Identifier: BSD-3-Clause
#include "io/plugin.h"

#include <dlfcn.h>

namespace pds
{

void* load_plugin_function(const std::string& name, const std::string& function)
{
  void* library = dlopen((name + ".so").c_str(), RTLD_NOW);
  void* address = library ? dlsym(library, function.c_str()) : nullptr;
  if (!address) {
    throw PluginError("the part of this program that does it cannot be loaded (" + std::string(dlerror()) +
                      "); install it again");
  }
  return address;
}

}  // namespace pds

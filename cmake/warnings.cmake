# SPDX-License-Identifier: BSD-3-Clause
# Warnings for every target of this project; a project that includes this one is spared them.
if(is_top_level AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  if(PCL_PDS_RECON_WARNINGS_AS_ERRORS)
    add_compile_options(-Werror)
  endif()
endif()

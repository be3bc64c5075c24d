// SPDX-License-Identifier: BSD-3-Clause
#include "html/assets.h"

// A file as it is, in the read-only data of the program, from NAME_begin to NAME_end.
#define EMBED(name, path)                                                                             \
  asm(".pushsection .rodata\n" #name "_begin:\n.incbin \"" path "\"\n" #name "_end:\n.popsection\n"); \
  extern "C" __attribute__((visibility("hidden"))) const char name##_begin[], name##_end[]

EMBED(pds_page_template, PAGE_TEMPLATE);
#ifdef MODEL_VIEWER_SCRIPT
EMBED(pds_model_viewer, MODEL_VIEWER_SCRIPT);
#endif

namespace pds
{

namespace
{

std::string_view text_between(const char* begin, const char* end)
{
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view page_template() { return text_between(pds_page_template_begin, pds_page_template_end); }

std::string_view model_viewer_script()
{
#ifdef MODEL_VIEWER_SCRIPT
  return text_between(pds_model_viewer_begin, pds_model_viewer_end);
#else
  return {};
#endif
}

}  // namespace pds

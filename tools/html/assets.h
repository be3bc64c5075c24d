// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace pds
{

/** \brief The page of --html with places for what fill_template() puts in. */
[[nodiscard]] std::string_view page_template();

/** \brief The script of model-viewer, which turns the mesh in the page; empty in a build without it. */
[[nodiscard]] std::string_view model_viewer_script();

}  // namespace pds

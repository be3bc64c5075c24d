// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace pds
{

/** \brief Checks a PCD file in memory before PCL reads it.
 *
 * PCL asks for the memory that the header announces before it looks at the data, and takes rows of a text that are too
 * short, too long or no numbers for zeros.
 * \throws InvalidInput if the header announces more than the file holds, or naming the row that is wrong
 */
void check_pcd(std::string_view file);

}  // namespace pds

// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/keys.h"

#include "viewer/view_data.h"

namespace pds
{

std::string key_help()
{
  std::string text;
  for (const LayerName& layer : layer_names) {
    text += std::string("  ") + layer.key + "        " + layer.name + " on and off\n";
  }
  return text +
         "  f        faces smooth, flat or as a wireframe\n"
         "  o        colours of the scan, where it has any, or our own\n"
         "  + -      larger or smaller Poisson-disk radius\n"
         "  a        next adaptive coefficient: 0, 0.1, 0.2, 0.3\n"
         "  p        the vertex or point under the pointer: index, cell, fields\n"
         "  K k      save the camera and print it for --camera; return to it\n"
         "  r        show everything\n"
         "  h        these keys on and off\n"
         "  q        leave\n";
}

}  // namespace pds

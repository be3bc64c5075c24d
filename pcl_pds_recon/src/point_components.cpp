// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/point_components.h>

#include "bucket_sort.h"

namespace pds
{

PointComponents find_components(const NeighborGraph& graph)
{
  constexpr std::uint32_t unknown = 0xffffffffU;
  PointComponents components;
  components.component.assign(graph.size(), unknown);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < graph.size(); ++first) {
    if (components.component[first] != unknown) continue;
    components.component[first] = count;
    for (open.assign(1, first); !open.empty();) {
      const std::uint32_t i = open.back();
      open.pop_back();
      for (const std::uint32_t j : graph.neighbors(i))
        if (components.component[j] == unknown) {
          components.component[j] = count;
          open.push_back(j);
        }
    }
    ++count;
  }
  BucketSort sort(count);
  for (const std::uint32_t c : components.component) sort.count(c);
  components.begin = sort.begins();
  components.point.resize(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i) components.point[sort.place(components.component[i])] = i;
  return components;
}

}  // namespace pds

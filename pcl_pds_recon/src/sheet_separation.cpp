// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/sheet_separation.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>
#include "plane_kernel.h"
#include "sheet_rule.h"
#include "sheets.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 1024;  // points per block: where there are sheets, each takes some microseconds

constexpr std::size_t fewest_left = 3;  // neighbours: with fewer a point is on no surface, and keeps those it has

// Scans that do not fit are layers, a few of which may seem two sheets where they happen to be farthest apart: no
// farther than layers are thick elsewhere.
constexpr std::size_t noise_stride = 16;  // one point in so many is asked
constexpr std::size_t noisy_share = 4;    // it is usual if one point in so many has a thick neighbourhood
constexpr float least_over_noise = 2.5F;  // half gaps over deviations; noise of 0.3 on sheets two apart gives 3.2

/** \brief Looks at those points of a block whose neighbourhoods are no planes; at a few of them only, if these find
 * noise and no sheets. */
std::vector<Sheet> find_sheets(const SurfaceEstimate& surface,
                               const std::vector<std::uint8_t>& candidate,
                               std::size_t begin,
                               std::size_t end,
                               SheetRule& rule)
{
  constexpr std::size_t few = 32;
  constexpr std::size_t many = 2 * few;
  constexpr std::size_t least_share = 16;  // one in so many; of sheets it is a quarter and more
  std::vector<std::uint32_t> thick;
  for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i)
    if (surface.curvature[i] > SheetRule::thick && (candidate.empty() || candidate[i] != 0)) thick.push_back(i);
  std::vector<Sheet> found;
  Sheet sheet;
  if (thick.size() > many) {
    std::size_t sheets = 0;
    for (std::size_t sample = 0; sample < few; ++sample)
      sheets += rule.find(thick[sample * thick.size() / few], sheet) ? 1 : 0;
    if (sheets * least_share < few) return found;
  }
  for (const std::uint32_t i : thick)
    if (rule.find(i, sheet)) found.push_back(sheet);
  return found;
}

/** \brief How sure it is that a point has a second sheet, by what its neighbours find. */
enum class Agreement
{
  none,
  some,
  certain
};

Agreement agreement_on(const Sheet& sheet,
                       const Sheets& found,
                       const NeighborGraph& graph,
                       const SurfaceEstimate& surface)
{
  constexpr std::size_t least_share = 3;  // one in so many
  // Noise makes also those thick that are all on one sheet.
  const auto is_witness = [&](std::uint32_t j) {
    return surface.curvature[j] > SheetRule::thick && (sheet.strays == 0 || found.reaches_across(sheet, j));
  };
  std::size_t witnesses = 0;
  std::size_t agreeing = 0;
  const NeighborSpan row = graph.nearest(sheet.point);
  for (const std::uint32_t j : row) {
    witnesses += is_witness(j) ? 1 : 0;
    agreeing += found.of(j) != nullptr ? 1 : 0;
  }
  if (agreeing * least_share < witnesses) return Agreement::none;
  // Few witnesses are none: at a sharp edge a handful of points may look like noisy sheets.
  if (sheet.strays == 0 || agreeing * least_share >= row.size()) return Agreement::certain;
  return agreeing * least_share > witnesses ? Agreement::some : Agreement::none;
}

/** \brief Sheets that the neighbours agree on, for chance may show one to a single point. Noisy ones begin where it is
 * certain, and go on to where there is some agreement. */
Sheets choose_sheets(std::vector<std::vector<Sheet>> of_block,
                     const OrderedPoints& points,
                     const NeighborGraph& graph,
                     const SurfaceEstimate& surface)
{
  Sheets found(points, graph);
  for (std::vector<Sheet>& part : of_block)
    for (Sheet& sheet : part) found.add(std::move(sheet));
  Sheets chosen(points, graph);
  std::vector<std::uint32_t> reached;
  const auto choose = [&](const Sheet& sheet) {
    if (chosen.of(sheet.point) != nullptr) return;
    chosen.add(sheet);
    reached.push_back(sheet.point);
  };
  for (const Sheet& sheet : found.all())
    if (agreement_on(sheet, found, graph, surface) == Agreement::certain) choose(sheet);
  while (!reached.empty()) {
    const std::uint32_t point = reached.back();
    reached.pop_back();
    for (const std::uint32_t j : graph.nearest(point))
      if (const Sheet* next = found.of(j); next != nullptr && chosen.of(j) == nullptr)
        if (agreement_on(*next, found, graph, surface) != Agreement::none) choose(*next);
  }
  return chosen;
}

/** \brief Deviation of the noise where there is but one sheet, in reaches; 0 if there is little, or no such place. */
float noise_of_single_sheets(const Sheets& sheets, const SurfaceEstimate& surface, std::size_t size)
{
  std::vector<float> thick;
  for (std::size_t i = 0; i < size; i += noise_stride)
    if (surface.curvature[i] > SheetRule::thick && !sheets.are_near(static_cast<std::uint32_t>(i)))
      thick.push_back(surface.curvature[i]);
  if (thick.empty() || thick.size() * noise_stride * noisy_share < size) return 0;
  const auto middle = thick.begin() + static_cast<std::ptrdiff_t>(thick.size() / 2);
  std::nth_element(thick.begin(), middle, thick.end());
  // Curvature squared is the share of the variance across the plane; along it a disk has half of its squared radius.
  const float share = *middle * *middle;
  return std::sqrt(0.5F * share / (1 - share));
}

/** \brief Of the sheets at a point and at its neighbours: one of several layers may be near by chance. */
float mean_half_gap(const Sheet& sheet, const Sheets& sheets, const NeighborGraph& graph)
{
  float sum = sheet.half_gap;
  float count = 1;
  for (const std::uint32_t j : graph.nearest(sheet.point))
    if (const Sheet* const other = sheets.of(j); other != nullptr) {
      sum += other->half_gap;
      ++count;
    }
  return sum / count;
}

/** \brief Those that are farther apart than noise elsewhere is thick. */
Sheets wider_than_noise(Sheets sheets,
                        const OrderedPoints& points,
                        const NeighborGraph& graph,
                        const SurfaceEstimate& surface)
{
  const float least = least_over_noise * noise_of_single_sheets(sheets, surface, points.size());
  if (least == 0) return sheets;
  Sheets wide(points, graph);
  for (const Sheet& sheet : sheets.all())
    if (mean_half_gap(sheet, sheets, graph) > least * std::sqrt(graph.reach[sheet.point].squared)) wide.add(sheet);
  return wide;
}

}  // namespace

SheetCounts separate_sheets(const PointCloudView& cloud,
                            const OrderedPoints& points,
                            NeighborGraph& graph,
                            SurfaceEstimate& surface,
                            const Parallel& parallel,
                            const std::vector<std::uint8_t>& candidate)
{
  std::vector<std::vector<Sheet>> of_block((points.size() + block - 1) / block);
  parallel.blocks(points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    SheetRule rule(cloud, points, graph, surface);
    of_block[begin / block] = find_sheets(surface, candidate, begin, end, rule);
  });
  Sheets chosen = choose_sheets(std::move(of_block), points, graph, surface);
  chosen.spread();
  const std::size_t seeming = chosen.all().size();
  // Normals tell more than noise does, and have been asked already.
  const Sheets sheets = cloud.normals ? std::move(chosen) : wider_than_noise(std::move(chosen), points, graph, surface);
  const SheetCounts counts{sheets.all().size(), seeming - sheets.all().size()};
  if (sheets.all().empty()) return counts;

  const bool full = graph.own_count.empty();
  if (full) graph.own_count.resize(points.size());
  const InstructionSet set = best_instruction_set();
  parallel.each(points.size(), block, [&](std::size_t at) {
    if (full) graph.own_count[at] = static_cast<std::uint16_t>(graph.stride);
    const auto i = static_cast<std::uint32_t>(at);
    if (!sheets.are_near(i)) return;
    const std::vector<std::uint32_t> row = sheets.own_row(i);
    if (row.size() < fewest_left) return;
    std::copy(row.begin(), row.end(), graph.own.begin() + static_cast<std::ptrdiff_t>(at * graph.stride));
    graph.own_count[at] = static_cast<std::uint16_t>(row.size());
    graph.reach[at] = {(points.position[at] - points.position[row.back()]).squaredNorm(), Reach::parted};
    fit_planes(set, points, graph, at, at + 1, surface);
  });
  return counts;
}

}  // namespace pds

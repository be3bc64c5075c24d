// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/curve_extraction.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace pds
{
namespace
{

constexpr std::uint32_t none = NearestSeeds::none;

// A way that leads by a third seed is as long as its two parts, but for a bend; the third side of a ring of three seeds
// is shorter, for it is below 2 R, and the others are beyond R.
constexpr float detour = 1.1F;

struct Adjacent
{
  std::uint32_t seed;
  float path;
};
using Adjacency = std::vector<std::vector<Adjacent>>;

Adjacency adjacency_of(const std::vector<SeedPair>& pairs, std::size_t seeds)
{
  Adjacency adjacent(seeds);
  for (const SeedPair& p : pairs) {
    adjacent[p.a].push_back({p.b, p.path});
    adjacent[p.b].push_back({p.a, p.path});
  }
  return adjacent;
}

/** \brief True if a third seed lies on the way from one to the other. */
bool is_shortcut(const SeedPair& pair, const Adjacency& adjacent)
{
  return std::any_of(adjacent[pair.a].begin(), adjacent[pair.a].end(), [&](const Adjacent& to_a) {
    if (to_a.path >= pair.path) return false;
    return std::any_of(adjacent[to_a.seed].begin(), adjacent[to_a.seed].end(), [&](const Adjacent& to_b) {
      return to_b.seed == pair.b && to_b.path < pair.path && to_a.path + to_b.path < detour * pair.path;
    });
  });
}

/** \brief The seeds that each seed is joined to. */
class Links
{
 public:
  explicit Links(std::size_t seeds) : next_(seeds, {none, none}) {}

  void join(std::uint32_t a, std::uint32_t b)
  {
    if (degree(a) == 2 || degree(b) == 2) return;
    next_[a][degree(a)] = b;
    next_[b][degree(b)] = a;
  }
  [[nodiscard]] std::size_t degree(std::uint32_t s) const
  {
    return static_cast<std::size_t>(2 - std::count(next_[s].begin(), next_[s].end(), none));
  }

  /** \brief Follows the links from a seed on, away from it until they end or come back to it. */
  [[nodiscard]] Curve trace(std::uint32_t first) const
  {
    Curve curve{{first}, false};
    std::uint32_t before = first;
    // Of a ring the lower neighbour comes first.
    std::uint32_t at = std::min(next_[first][0], next_[first][1]);
    while (at != none && at != first) {
      curve.seeds.push_back(at);
      const std::uint32_t ahead = next_[at][0] == before ? next_[at][1] : next_[at][0];
      before = at;
      at = ahead;
    }
    curve.closed = at == first;
    return curve;
  }

 private:
  std::vector<std::array<std::uint32_t, 2>> next_;
};

}  // namespace

std::vector<Curve> extract_curves(const std::vector<SeedPair>& pairs, std::size_t seeds)
{
  const Adjacency adjacent = adjacency_of(pairs, seeds);
  std::vector<SeedPair> direct;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(direct),
               [&](const SeedPair& p) { return !is_shortcut(p, adjacent); });
  std::sort(direct.begin(), direct.end(), [](const SeedPair& p, const SeedPair& q) {
    return std::tie(p.path, p.a, p.b) < std::tie(q.path, q.a, q.b);
  });
  Links links(seeds);
  for (const SeedPair& p : direct) links.join(p.a, p.b);

  std::vector<Curve> curves;
  std::vector<std::uint8_t> traced(seeds);
  for (const std::size_t degree : {1U, 2U})
    for (std::uint32_t s = 0; s < seeds; ++s) {
      if (links.degree(s) != degree || traced[s] != 0) continue;
      curves.push_back(links.trace(s));
      for (const std::uint32_t t : curves.back().seeds) traced[t] = 1;
    }
  return curves;
}

}  // namespace pds

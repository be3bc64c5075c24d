// SPDX-License-Identifier: BSD-3-Clause
// What the machine allows, to hold the stages' times against: work that needs nothing but a core, reading of memory,
// and new memory, which the system has to clear; with one thread and with all cores.
#include <benchmark/benchmark.h>
#include <pcl_pds_recon/parallel.h>
#include <sys/mman.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <new>
#include <numeric>
#include <vector>

namespace
{

using pds::Parallel;

constexpr std::size_t mebibyte = 1U << 20;
constexpr std::size_t large = 512 * mebibyte;  // bytes: far more than any cache holds
constexpr std::size_t block = mebibyte;

/** \brief Registers a loop of as many rounds as given, each of a mebibyte or of as much work as one takes. */
void add(const char* name, std::size_t rounds, const std::function<void(const Parallel&)>& loop)
{
  const auto run = [rounds, loop](benchmark::State& state) {
    const Parallel parallel(static_cast<unsigned>(state.range(0)));
    for (auto _ : state) loop(parallel);
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(rounds * block));
  };
  auto* const bench = benchmark::RegisterBenchmark(name, run)->UseRealTime()->ArgName("threads");
  bench->Arg(1)->Arg(static_cast<int>(Parallel().threads()));
}

/** \brief Random numbers, each from the one before: nothing that cores or threads of a core share. */
void compute(const Parallel& parallel)
{
  constexpr std::size_t rounds = 256;
  parallel.blocks(rounds, 1, [](std::size_t begin, std::size_t, unsigned) {
    std::uint64_t state = begin + 1;
    for (std::size_t i = 0; i < block; ++i) {
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
    }
    benchmark::DoNotOptimize(state);
  });
}

void read_memory(const std::vector<std::uint64_t>& memory, const Parallel& parallel)
{
  constexpr std::size_t words = block / sizeof(std::uint64_t);
  parallel.blocks(memory.size(), words, [&memory](std::size_t begin, std::size_t end, unsigned) {
    benchmark::DoNotOptimize(std::accumulate(memory.data() + begin, memory.data() + end, std::uint64_t{0}));
  });
}

/** \brief Writes to each page of new memory, and gives it back. */
void touch_new_memory(const Parallel& parallel)
{
  constexpr std::size_t page = 4096;  // bytes
  void* const memory = mmap(nullptr, large, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, large, MADV_HUGEPAGE);  // as the library asks for
  parallel.blocks(large, block, [memory](std::size_t begin, std::size_t end, unsigned) {
    for (std::size_t i = begin; i < end; i += page) static_cast<volatile char*>(memory)[i] = 1;
  });
  munmap(memory, large);
}

}  // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const std::vector<std::uint64_t> memory(large / sizeof(std::uint64_t), 1);
  add("compute", large / block / 2, compute);
  add("read_memory", large / block, [&memory](const Parallel& parallel) { read_memory(memory, parallel); });
  add("new_memory", large / block, touch_new_memory);
  benchmark::RunSpecifiedBenchmarks();
}

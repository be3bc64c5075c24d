#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reconstructs ever larger clouds of one surface with one thread and with all, and prints as Markdown how time and memory
grow, what a second thread gains, and how far each stage is from what memory allows.

Needs the package python3-matplotlib for --plot. docs/performance.md shows the result.
"""
import argparse
import json
import os
import shlex
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "bench" / "peers"))
import process  # noqa: E402
import table  # noqa: E402

TIMEOUT = 3600  # seconds, for one run
STAGES = {"neighbors": "neighbours", "weights": "weights", "sampling": "sampling", "voronoi": "Voronoi",
          "seed_graph": "seed graph", "faces": "faces", "holes": "holes", "orientation": "orientation, output",
          "placement": "edge flips"}
PROGRAMS = ("pcl_pds_recon", "bumpy_torus", "pcl_pds_recon_machine_bench")


@dataclass(frozen=True)
class Run:
    seconds: dict  # by stage, and "load", "save", "total"
    peak_bytes: int
    vertices: int

    @property
    def work(self):
        """Seconds of the work in memory."""
        return self.seconds["total"] - self.seconds["load"] - self.seconds["save"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, nargs="+", default=[250_000, 1_000_000, 4_000_000, 16_000_000],
                        metavar="N", help="sizes of the cloud")
    parser.add_argument("--repeat", type=int, default=3, metavar="N", help="interleaved rounds (3)")
    parser.add_argument("--build", type=Path, default=REPOSITORY / "build" / "release", metavar="DIR",
                        help="where to build (build/release)")
    parser.add_argument("--output", type=Path, metavar="FILE.md", help="also write the tables here")
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="draw time and memory over size")
    given = parser.parse_args()
    if min(given.points) < 1000 or given.repeat < 1:
        parser.error("--points takes 1000 and more, --repeat 1 and more")
    return given


def build(folder):
    for command in (["cmake", "-S", REPOSITORY, "-B", folder, "-DCMAKE_BUILD_TYPE=Release"],
                    ["cmake", "--build", folder, "--parallel", str(os.cpu_count()), "--target", *PROGRAMS]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}run.py: cannot build in {folder}; see above")


def reconstruct(program, cloud, threads):
    with tempfile.TemporaryDirectory(prefix="scaling.") as work:
        report, mesh = Path(work) / "report.json", Path(work) / "mesh.ply"
        process.run([program, "--quiet", "--threads", str(threads), "--report", report, cloud, mesh], threads, TIMEOUT)
        values = json.loads(report.read_text(encoding="utf-8"))
    return Run(values["seconds"], values["peak_rss_bytes"], values["vertices"])


def measure(given, threads):
    """Runs by number of points and of threads; every round runs all of them."""
    runs = {}
    program = given.build / "tools" / "pcl_pds_recon"
    with tempfile.TemporaryDirectory(prefix="scaling.") as scratch:
        clouds = {points: Path(scratch) / f"{points}.ply" for points in given.points}
        for points, cloud in clouds.items():
            process.run([given.build / "bench" / "peers" / "bumpy_torus", str(points), cloud, os.devnull], 1, TIMEOUT)
        for number in range(given.repeat):
            for points, cloud in clouds.items():
                for count in threads:
                    run = reconstruct(program, cloud, count)
                    runs.setdefault((points, count), []).append(run)
                    print(f"round {number + 1}: {points} points, {in_words(count)}: {run.work:.3f} s", file=sys.stderr)
    return runs


def machine_rates(folder, repeat):
    """Bytes a second, by what is done and the number of threads."""
    command = [folder / "bench" / "pcl_pds_recon_machine_bench", "--benchmark_format=json",
               f"--benchmark_repetitions={repeat}"]
    values = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    samples = {}
    for entry in values["benchmarks"]:
        if entry["run_type"] == "iteration":
            name, threads = entry["run_name"].split("/")[:2]
            samples.setdefault((name, int(threads.split(":")[1])), []).append(entry["bytes_per_second"])
    return {key: statistics.median(rates) for key, rates in samples.items()}


def median(runs, value):
    return statistics.median(value(run) for run in runs)


def in_words(threads):
    return f"{threads} thread" + ("s" if threads > 1 else "")


def row(cells):
    return "| " + " | ".join(cells) + " |"


def growth_table(given, runs, threads):
    lines = [row(["points", "vertices", *[f"seconds, {in_words(count)}" for count in threads], "gain",
                  "over the size before", "with files", "peak, bytes a point"]), row(["---"] * (6 + len(threads)))]
    before = None
    for points in given.points:
        work = [median(runs[points, count], lambda run: run.work) for count in threads]
        most = runs[points, threads[-1]]
        files = median(most, lambda run: run.seconds["total"] / run.work)
        growth = f"{work[-1] / before[1]:.2f} for {points / before[0]:g} x" if before else ""
        lines.append(row([f"{points:,}", f"{most[0].vertices:,}", *[f"{seconds:.3f}" for seconds in work],
                          f"{work[0] / work[-1]:.2f}", growth, f"{files:.2f} x",
                          f"{median(most, lambda run: run.peak_bytes) / points:.0f}"]))
        before = points, work[-1]
    return lines


def stage_table(points, runs, threads, rates):
    lines = [row(["stage", *[f"ns a point, {in_words(count)}" for count in threads], "gain",
                  "bytes a point that could be read meanwhile"]), row(["---"] * (3 + len(threads)))]
    bandwidth = rates["read_memory", threads[-1]]
    for key, name in STAGES.items():
        seconds = [median(runs[points, count], lambda run, key=key: run.seconds[key]) for count in threads]
        lines.append(row([name, *[f"{second / points * 1e9:.0f}" for second in seconds],
                          f"{seconds[0] / seconds[-1]:.2f}", f"{seconds[-1] / points * bandwidth:,.0f}"]))
    return lines


def page(given, runs, threads, rates):
    few, many = threads[0], threads[-1]
    gains = [f"{text} {rates[name, many] / rates[name, few]:.2f}" for name, text in
             (("compute", "computing"), ("read_memory", "reading memory"), ("new_memory", "touching new memory"))]
    largest = max((points for points in given.points if points <= 4_000_000), default=given.points[0])
    return "\n".join([
        f"`{shlex.join(['bench/scaling/run.py', *sys.argv[1:]])}`", "",
        f"Torus with bumps, defaults; medians of {given.repeat} interleaved rounds; load average {os.getloadavg()[0]:.1f}. "
        f"{table.machine()}.", "", *growth_table(given, runs, threads), "",
        f"What {many} threads gain over {few} in plain loops: {', '.join(gains)}. Memory gives "
        f"{rates['read_memory', many] / 1e9:.1f} GB/s to {many} threads, new memory {rates['new_memory', many] / 1e9:.1f}.",
        "", f"Stages at {largest:,} points:", "", *stage_table(largest, runs, threads, rates), ""])


def plot(given, runs, threads, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (time, memory) = pyplot.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for count in threads:
        time.loglog(given.points, [median(runs[points, count], lambda run: run.work) for points in given.points], "o-",
                    label=in_words(count))
    first = median(runs[given.points[0], threads[-1]], lambda run: run.work)
    time.loglog(given.points, [first * points / given.points[0] for points in given.points], "--", color="gray",
                label="in proportion")
    time.set(xlabel="points", ylabel="seconds, in memory")
    time.legend()
    memory.semilogx(given.points, [median(runs[points, threads[-1]], lambda run: run.peak_bytes) / points
                                   for points in given.points], "o-")
    memory.set(xlabel="points", ylabel="peak of resident memory, bytes a point", ylim=(0, None))
    for axes in (time, memory):
        axes.grid(True, which="major", alpha=0.4)
    figure.savefig(file, dpi=100, metadata={"Software": None})


def main():
    given = arguments()
    given.points.sort()
    threads = sorted({1, len(os.sched_getaffinity(0))})
    build(given.build)
    try:
        runs = measure(given, threads)
    except process.Failure as failure:
        sys.exit(f"run.py: {failure}")
    result = page(given, runs, threads, machine_rates(given.build, given.repeat))
    print(result, end="")
    if given.output:
        given.output.write_text(result, encoding="utf-8")
    if given.plot:
        plot(given, runs, threads, given.plot)


main()

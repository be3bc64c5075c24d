# SPDX-License-Identifier: BSD-3-Clause
"""The comparison as a Markdown page."""
import os
import platform
import shlex
import statistics
import subprocess
import sys

PACKAGES = ["libpcl-dev", "libcgal-dev", "python3-open3d", "meshlab", "libflann-dev", "g++"]
COLUMNS = ["", "vertices", "seconds, clock / processors", "over kd-tree", "over ours", "bytes a point", "defects",
           "components", "boundary loops", "handles", "mean distance to / from", "smallest angle, mean / least"]
LEGEND = """\
Seconds of work in memory; the ratios are of the clock's. Bytes: peak above the loaded cloud, per point of it. Defects:
edges of more than two faces / vertices of more than one fan / edges run along twice in the same direction; handles are
counted only without defects. Distances: of points evenly over the mesh to the reference / the other way, in 1e-5 of the
reference's diagonal. †: the process less one that only loads and saves."""


def machine():
    with open("/proc/cpuinfo", encoding="ascii") as lines:
        models = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    gib = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    processor = models[0] if models else platform.machine()
    system = platform.freedesktop_os_release()["PRETTY_NAME"]
    return f"{processor}, {os.cpu_count()} cores, {gib:.0f} GiB; {system}"


def versions():
    query = ["dpkg-query", "--show", "--showformat=${Package} ${Version}\n", *PACKAGES]
    lines = subprocess.run(query, capture_output=True, text=True, check=False).stdout.splitlines()
    return ", ".join(lines)


def row(peer, runs, yardstick, ours, verdict):
    """Ratios are medians of the ratios inside each round."""
    seconds = statistics.median(run.seconds for run in runs)
    processor_seconds = statistics.median(run.processor_seconds for run in runs)
    bytes_a_point = statistics.median(run.peak_bytes for run in runs) / ours[0].points
    cells = [peer.title, f"{verdict['vertices']:,}" if verdict else "", f"{seconds:.2f} / {processor_seconds:.2f}",
             _ratio(runs, yardstick), _ratio(runs, ours), f"{bytes_a_point:.0f}"]
    return _line(cells + (_verdict_cells(verdict) if verdict else []))


def row_without(peer, reason):
    return _line([peer.title, "", reason])


def _ratio(runs, others):
    return f"{statistics.median(a.seconds / b.seconds for a, b in zip(runs, others)):.2f}" if others else ""


def _verdict_cells(v):
    defects = [v["nonmanifold_edges"], v["nonmanifold_vertices"], v["inconsistent_edges"]]
    cells = [" / ".join(map(str, defects)), str(v["components"]), str(v["boundary_loops"]),
             "" if any(defects) else str(v["genus"])]
    if "to_reference_mean" in v:
        cells.append(f"{v['to_reference_mean'] * 1e5:.2f} / {v['from_reference_mean'] * 1e5:.2f}")
    else:
        cells.append("")
    return cells + [f"{v['mean_smallest_angle']:.1f}° / {v['smallest_angle']:.1f}°"]


def _line(cells):
    return "| " + " | ".join(cells + [""] * (len(COLUMNS) - len(cells))) + " |"


def page(cloud, points, threads, rounds, load, truth, rows):
    lines = [f"`{shlex.join(['bench/peers/run.py', *sys.argv[1:]])}`", "",
             f"{cloud}, {points:,} points; {threads} threads; medians of {rounds} interleaved runs; load average "
             f"before them {load:.1f}. {machine()}. {versions()}.", "",
             _line(COLUMNS), _line(["---"] * len(COLUMNS)), *rows, ""]
    if truth:
        lines += [f"The reference: components {truth['reference_components']}, boundary loops "
                  f"{truth['reference_boundary_loops']}, handles {truth['reference_genus']}.", ""]
    lines += [LEGEND]
    return "\n".join(lines) + "\n"

#!/usr/bin/env python3
"""Draws what the suites of `boxwood bench` measured: the files of --json FILE.

    bench/plots.py FILE... -o FOLDER

Pictures, each where the rows have what it needs:
    amortize-SCENE.png build plus trace against rays, and what share of the best rate that is, by total time
    measures.png       how well each measure of a tree tells the time of a ray, and that time against four of them
    refit-SCENE.png    refit against rebuild by frame: times, SAH cost, rays per second
    peers-THREADS.png  rays per second over the best Embree variant's, by scene and kind of rays
    builds-SCENE.png   what builds take, beside those of Embree
    scale-THREADS.png  build, bytes and rays per second of one terrain in growing sizes
    error-speed.png    rays per second against largest error and wrong answers, with the Pareto front
    error-time.png     build time + N rays against largest error
    error-bytes.png    bytes against largest error
    error-bound.png    printed bound against measured error: all points lie below the diagonal
    error-scale.png    wrong answers against scale  (rows of --series scale)
    error-offset.png   wrong answers against offset (rows of --series offset)

Rows of `error` of several scenes are one point for each structure and contestant: geometric means of rates, times and bytes,
the largest of errors. Needs matplotlib (Debian: python3-matplotlib).
"""
import argparse
import json
import math
import os
import sys

import plots_peers

COLORS = {"exact": "#0072b2", "fast": "#d55e00", "double": "#009e73"}  # told apart by all kinds of eyes
MARKERS = "osD^vP*Xhd<>p"
RAY_COUNTS = (1e5, 1e6, 1e7)


def read_rows(files):
    """All rows of each command; those of `bench measures` with its predictions under a name of their own."""
    rows = {}
    for name in files:
        with open(name, encoding="utf-8") as file:
            report = json.load(file)
        rows.setdefault(report["command"], []).extend(report["rows"])
        if "predictions" in report:
            rows.setdefault("predictions", []).extend(report["predictions"])
    return rows


def error_rows(rows):
    rows = [row for row in rows if "contestant" in row and "rays_kind" in row]
    return [row for row in rows if row["t_error_ulps"] is not None]  # null: an infinite t for a finite one


def file_word(scene):
    """The scene's name as a part of a file's name."""
    return "".join(c if c.isalnum() or c in "-_." else "_" for c in os.path.basename(scene))


def geometric_mean(values):
    values = [value for value in values if value is not None and value > 0]
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


def wrong_per_million(row):
    return 1e6 * row["wrong"] / max(row["sample"], 1)


def points_of(rows):
    """One point for each kind of rays, recipe and contestant, over all scenes."""
    groups = {}
    for row in rows:
        groups.setdefault((row["rays_kind"], row["recipe"], row["contestant"]), []).append(row)
    points = []
    for (rays_kind, recipe, contestant), group in groups.items():
        rates = [row["mrays_per_s"] for row in group]
        points.append({
            "rays_kind": rays_kind,
            "recipe": recipe,
            "contestant": contestant,
            "rate": geometric_mean(rates) if None not in rates else None,
            "bytes": geometric_mean([row["bytes"] for row in group]),
            "t_error": max(row["t_error_ulps"] for row in group),
            "wrong": 1e6 * sum(row["wrong"] for row in group) / max(sum(row["sample"] for row in group), 1),
            "total_ms": {count: geometric_mean([row["build_ms"] + count / row["mrays_per_s"] / 1e3
                                                for row in group]) for count in RAY_COUNTS}
                        if None not in rates else None,
        })
    return points


def pareto(points, x_key, y_key, more_x):
    """Points that no other beats in both: from the best x on, each with a smaller y than all before."""
    front = []
    for point in sorted(points, key=lambda p: (-p[x_key] if more_x else p[x_key], p[y_key])):
        if not front or point[y_key] < front[-1][y_key]:
            front.append(point)
    return front


class Plots:
    def __init__(self, pyplot, rows, folder):
        self.plt = pyplot
        self.folder = folder
        self.plain = [row for row in rows if "scale" not in row and "offset" not in row]
        self.series = {key: [row for row in rows if key in row] for key in ("scale", "offset")}
        self.points = points_of(self.plain)
        self.kinds = sorted({row["rays_kind"] for row in rows}, reverse=True)
        self.recipes = sorted({row["recipe"] for row in rows})
        self.scene_count = len({row["scene"] for row in self.plain})

    def marker(self, recipe):
        return MARKERS[self.recipes.index(recipe) % len(MARKERS)]

    def over_scenes(self, text):
        return text if self.scene_count == 1 else f"{text}, geometric mean of {self.scene_count} scenes"

    def scatter(self, axes, points, x_key, y_key):
        for point in points:
            axes.scatter(point[x_key], point[y_key], s=70, alpha=0.85, linewidths=0.6, edgecolors="white",
                         color=COLORS.get(point["contestant"], "gray"), marker=self.marker(point["recipe"]))

    def front(self, axes, points, x_key, y_key, more_x=False):
        front = pareto(points, x_key, y_key, more_x)
        axes.plot([p[x_key] for p in front], [p[y_key] for p in front], color="#555555", linewidth=1.2, zorder=0)

    def decorate(self, axes, x_label, y_label, title, zero=None):
        axes.set_xlabel(x_label)
        axes.set_ylabel(y_label)
        axes.set_title(title)
        axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
        if y_label.endswith("ulps") and zero is None:
            axes.set_yscale("log")
            axes.set_ylim(min(axes.get_ylim()[0], 0.3), max(axes.get_ylim()[1], 20))
        if zero is not None:  # logarithmic with a place for 0
            axes.set_yscale("symlog", linthresh=zero)
            axes.set_ylim(-zero / 3, max(axes.get_ylim()[1], 100 * zero))

    def save(self, figure, name, recipes=None):
        handles = [self.plt.Line2D([], [], linestyle="", marker="o", color=color, label=contestant)
                   for contestant, color in COLORS.items()]
        handles += [self.plt.Line2D([], [], linestyle="", marker=self.marker(recipe), color="gray", label=recipe)
                    for recipe in (self.recipes if recipes is None else recipes)]
        columns = 2 if len(handles) > 6 else 3
        lines = -(-len(handles) // columns)
        height = figure.get_figheight()
        below = (0.32 + 0.22 * lines) / height
        figure.tight_layout(rect=(0, below, 1, 1))
        figure.legend(handles=handles, loc="lower center", ncol=columns, frameon=False, fontsize=9)
        path = os.path.join(self.folder, name)
        figure.savefig(path, dpi=120)
        self.plt.close(figure)
        print(path)

    def panels(self, rows, columns, height=4.4):
        return self.plt.subplots(rows, columns, squeeze=False,
                                 figsize=(max(5.2 * columns, 7.0), height * rows + 1.6))

    def speed(self):
        points = [point for point in self.points if point["rate"] is not None]
        if not points:
            return
        figure, axes = self.panels(2, len(self.kinds), 3.8)
        for column, kind in enumerate(self.kinds):
            own = [point for point in points if point["rays_kind"] == kind]
            for row, (key, label, zero) in enumerate((("t_error", "largest error of t, ulps", None),
                                                      ("wrong", "wrong answers per million rays", 10))):
                self.scatter(axes[row][column], own, "rate", key)
                self.front(axes[row][column], own, "rate", key, more_x=True)
                self.decorate(axes[row][column], self.over_scenes("million rays per second"), label,
                              f"{kind} rays", zero)
        self.save(figure, "error-speed.png")

    def time(self):
        points = [point for point in self.points if point["total_ms"] is not None]
        if not points:
            return
        figure, axes = self.panels(len(self.kinds), len(RAY_COUNTS), 3.8)
        for row, kind in enumerate(self.kinds):
            for column, count in enumerate(RAY_COUNTS):
                own = [dict(point, total=point["total_ms"][count] / 1000) for point in points
                       if point["rays_kind"] == kind]
                self.scatter(axes[row][column], own, "total", "t_error")
                self.front(axes[row][column], own, "total", "t_error")
                self.decorate(axes[row][column], "build + rays, seconds", "largest error of t, ulps",
                              f"{count:,.0f} {kind} rays")
        if self.scene_count > 1:
            figure.suptitle(f"Geometric mean of {self.scene_count} scenes")
        self.save(figure, "error-time.png")

    def bytes(self):
        if not self.points:
            return
        figure, axes = self.panels(1, len(self.kinds))
        for column, kind in enumerate(self.kinds):
            own = [dict(point, mb=point["bytes"] / 1e6) for point in self.points if point["rays_kind"] == kind]
            self.scatter(axes[0][column], own, "mb", "t_error")
            self.front(axes[0][column], own, "mb", "t_error")
            self.decorate(axes[0][column], self.over_scenes("megabytes"), "largest error of t, ulps",
                          f"{kind} rays")
        self.save(figure, "error-bytes.png")

    def bound(self):
        figure, axes = self.panels(1, 2, 5.0)
        found = False
        for column, (error, limit, what) in enumerate((("t_error_ulps", "t_bound_ulps", "largest"),
                                                       ("t_error_p99_ulps", "t_bound_p99_ulps", "99th percentile"))):
            rows = [row for row in self.plain + self.series["scale"] + self.series["offset"]
                    if row.get(limit) and row.get(error)]
            if not rows:
                continue
            found = True
            for row in rows:
                axes[0][column].scatter(row[limit], row[error], s=26, alpha=0.7, color=COLORS[row["contestant"]],
                                        marker="o" if row["rays_kind"] == "primary" else "s")
            ends = (min(row[error] for row in rows) / 2, max(row[limit] for row in rows) * 2)
            axes[0][column].plot(ends, ends, color="#555555", linewidth=1.0)
            axes[0][column].set_xscale("log")
            axes[0][column].set_yscale("log")
            self.decorate(axes[0][column], "printed bound, ulps", "measured error of t, ulps",
                          f"{what} of each row (squares: diffuse)")
        if found:
            self.save(figure, "error-bound.png", recipes=[])
        else:
            self.plt.close(figure)

    def failures(self, key, label):
        rows = self.series[key]
        if not rows:
            return
        figure, axes = self.panels(1, len(self.kinds))
        for column, kind in enumerate(self.kinds):
            for contestant, color in COLORS.items():
                own = [row for row in rows if row["rays_kind"] == kind and row["contestant"] == contestant]
                values = sorted({row[key] for row in own})
                worst = [max(wrong_per_million(row) for row in own if row[key] == value) for value in values]
                axes[0][column].plot(values, worst, color=color, marker="o", linewidth=1.4)
            self.decorate(axes[0][column], label, "wrong answers per million rays, worst structure",
                          f"{kind} rays", 10)
            axes[0][column].set_xscale("log")
        self.save(figure, f"error-{key}.png", recipes=[])

    def draw(self):
        self.speed()
        self.time()
        self.bytes()
        self.bound()
        self.failures("scale", "scale of the scene")
        self.failures("offset", "offset of the scene, in extents")


def recipe_style(recipes, recipe):
    index = recipes.index(recipe)
    return {"color": f"C{index % 10}", "marker": MARKERS[index % len(MARKERS)], "markersize": 4}


def save_with_legend(pyplot, figure, axes, path):
    handles, labels = axes.get_legend_handles_labels()
    columns = 3 if len(labels) > 4 else 2
    lines = -(-len(labels) // columns)
    figure.tight_layout(rect=(0, (0.3 + 0.22 * lines) / figure.get_figheight(), 1, 1))
    figure.legend(handles, labels, loc="lower center", ncol=columns, frameon=False, fontsize=9)
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
    print(path)


def draw_amortize(pyplot, rows, folder):
    for scene in dict.fromkeys(row["scene"] for row in rows):
        own = [row for row in rows if row["scene"] == scene]
        kinds = list(dict.fromkeys(row["rays_kind"] for row in own))
        recipes = list(dict.fromkeys(row["recipe"] for row in own))
        figure, axes = pyplot.subplots(len(kinds), 2, squeeze=False, figsize=(11, 4.2 * len(kinds) + 1.2))
        for row, kind in enumerate(kinds):
            for recipe in recipes:
                line = sorted((r for r in own if r["rays_kind"] == kind and r["recipe"] == recipe),
                              key=lambda r: r["rays"])
                style = recipe_style(recipes, recipe)
                seconds = [r["total_ms"] / 1000 for r in line]
                axes[row][0].plot([r["rays"] for r in line], seconds, label=recipe, **style)
                axes[row][1].plot(seconds, [100 * r["efficiency"] for r in line], **style)
            axes[row][0].set_yscale("log")
            axes[row][0].set_xlabel(f"{kind} rays")
            axes[row][0].set_ylabel("build + trace, seconds")
            axes[row][1].set_xlabel(f"build + trace of {kind} rays, seconds")
            axes[row][1].set_ylabel("rays per second of total time,\n% of the fastest structure's rate")
            for panel in axes[row]:
                panel.set_xscale("log")
                panel.grid(True, which="major", color="#dddddd", linewidth=0.6)
        figure.suptitle(f"{scene}: {own[0]['triangles']:,} triangles")
        save_with_legend(pyplot, figure, axes[0][0], os.path.join(folder, f"amortize-{file_word(scene)}.png"))


def draw_refit(pyplot, rows, folder):
    panels = (("build_ms", "refit_ms", "ms"), ("sah_cost", "refit_sah_cost", "SAH cost"),
              ("primary_mrays_per_s", "refit_primary_mrays_per_s", "million primary rays per second"),
              ("diffuse_mrays_per_s", "refit_diffuse_mrays_per_s", "million diffuse rays per second"))
    for scene in dict.fromkeys(row["scene"].split("@frame=")[0] for row in rows):
        own = [row for row in rows if row["scene"].split("@frame=")[0] == scene]
        recipes = list(dict.fromkeys(row["recipe"] for row in own))
        figure, axes = pyplot.subplots(2, 2, squeeze=False, figsize=(11, 9))
        for place, (built, refitted, label) in enumerate(panels):
            panel = axes[place // 2][place % 2]
            for recipe in recipes:
                line = sorted((r for r in own if r["recipe"] == recipe), key=lambda r: r["frame"])
                frames = [r["frame"] for r in line]
                style = recipe_style(recipes, recipe)
                panel.plot(frames, [r[built] for r in line], label=f"{recipe}, rebuilt", **style)
                panel.plot(frames, [r[refitted] for r in line], label=f"{recipe}, refitted", linestyle="--",
                           **style)
            panel.set_xlabel("frame")
            panel.set_ylabel(label)
            panel.grid(True, which="major", color="#dddddd", linewidth=0.6)
            if label == "ms":
                panel.set_yscale("log")
            else:
                panel.set_ylim(bottom=0)
        figure.suptitle(f"{scene}: {own[0]['triangles']:,} triangles, refitted from frame {own[0]['from']}")
        save_with_legend(pyplot, figure, axes[0][0], os.path.join(folder, f"refit-{file_word(scene)}.png"))


MEASURE_LABELS = {"steps_per_ray": "counted steps per ray", "sah_cost": "SAH cost", "sah_epo": "SAH and EPO",
                  "epo": "EPO", "lcv": "LCV", "overlap": "overlap", "empty_volume": "empty volume",
                  "leaf_size_variation": "leaf-size variation"}
FAMILIES = (("BVH, binary", "#0072b2", "o"), ("BVH, wide or late split", "#56b4e9", "^"),
            ("kd-tree", "#d55e00", "s"), ("octree, quadtree", "#009e73", "D"), ("grid", "#cc79a7", "v"))


def family_of(row):
    family = row["family"]
    if family == "binary BVH":
        return 0
    if "BVH" in family:
        return 1
    return 2 if "kd-tree" in family else 3 if "octree" in family else 4


def relative_points(rows, kind, value_of):
    """(measure, time, family) of each structure, both relative to their geometric means over the BVHs of the scene."""
    points = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        own = [(value_of(row), 1e3 / row[f"{kind}_mrays_per_s"], family_of(row)) for row in rows
               if row["scene"] == scene and row.get(f"{kind}_mrays_per_s") and row.get("epo") is not None]
        own = [point for point in own if point[0] and point[0] > 0]
        base = [point for point in own if point[2] == 0]
        if base:
            x_mean, y_mean = (geometric_mean([point[i] for point in base]) for i in (0, 1))
            points += [(x / x_mean, y / y_mean, family) for x, y, family in own]
    return points


def draw_correlations(panel, predictions, group):
    """A line for each measure: Pearson's and the mean rank correlation, primary above diffuse."""
    measures = list(MEASURE_LABELS)
    for kind, shift, color in (("primary", 0.16, "#0072b2"), ("diffuse", -0.16, "#d55e00")):
        for row in predictions:
            if row["structures"] != group or row["rays_kind"] != kind:
                continue
            y = len(measures) - 1 - measures.index(row["measure"]) + shift
            for key, marker in (("pearson", "o"), ("spearman", "D")):
                if row[key] is not None:
                    panel.plot(row[key], y, marker, color=color, markersize=6.5 if key == "pearson" else 5,
                               markerfacecolor=color if key == "pearson" else "white")
    panel.axvline(0, color="#555555", linewidth=1.0)
    panel.set_yticks(range(len(measures)), [MEASURE_LABELS[m] for m in reversed(measures)])
    panel.set_xlim(-1.03, 1.03)
    panel.set_ylim(-0.6, len(measures) - 0.4)
    panel.grid(True, color="#e4e4e4", linewidth=0.6)
    panel.set_axisbelow(True)
    panel.set_xlabel("correlation with the time of a ray\nwithin a scene")
    points = max((row["points"] for row in predictions if row["structures"] == group), default=0)
    scenes = max((row["scenes"] for row in predictions if row["structures"] == group), default=0)
    title = {"binary BVH": "binary BVHs", "fast binary BVH": "binary BVHs, up to 1.5 times the least time",
             "all boxes": "all structures of boxes"}[group]
    panel.set_title(f"{title}:\n{points} in {scenes} scenes", fontsize=11)


def draw_measures(pyplot, rows, predictions, folder):
    kind = "diffuse"
    panels = (("SAH cost", lambda row: row["sah_cost"]),
              ("EPO", lambda row: row["epo"]),
              ("LCV", lambda row: row["lcv"]),
              ("counted steps per ray", lambda row: row[f"{kind}_steps_per_ray"]))
    figure = pyplot.figure(figsize=(13, 9.6))
    grid = figure.add_gridspec(2, 12, height_ratios=(1.15, 1.0), hspace=0.38, wspace=0.9,
                               left=0.13, right=0.98, top=0.94, bottom=0.13)
    for column, group in enumerate(("binary BVH", "fast binary BVH", "all boxes")):
        panel = figure.add_subplot(grid[0, 4 * column:4 * column + 4])
        draw_correlations(panel, predictions, group)
        if column > 0:
            panel.set_yticklabels([])
    signs = [pyplot.Line2D([], [], linestyle="", marker=marker, color=color, label=label,
                           markerfacecolor=color if marker == "o" else "white")
             for color, word in (("#0072b2", "primary"), ("#d55e00", "diffuse"))
             for marker, label in (("o", f"{word}, of logarithms"), ("D", f"{word}, of ranks"))]
    figure.axes[0].legend(handles=signs, fontsize=8, loc="upper left", framealpha=0.95)
    for column, (label, value_of) in enumerate(panels):
        panel = figure.add_subplot(grid[1, 3 * column:3 * column + 3])
        points = relative_points(rows, kind, value_of)
        for family, (name, color, marker) in enumerate(FAMILIES):
            own = [point for point in points if point[2] == family]
            panel.scatter([p[0] for p in own], [p[1] for p in own], s=14, alpha=0.65, linewidths=0,
                          color=color, marker=marker)
        ends = (0.1, 64)
        panel.plot(ends, ends, color="#555555", linewidth=1.0, zorder=0)
        panel.set_xscale("log", base=2)
        panel.set_yscale("log", base=2)
        for axis in (panel.xaxis, panel.yaxis):
            axis.set_major_formatter(lambda value, _: f"{value:g}")
        panel.set_xlim(0.1, 64)
        panel.set_ylim(0.1, 64)
        panel.grid(True, color="#e4e4e4", linewidth=0.6)
        panel.set_axisbelow(True)
        panel.set_xlabel(label)
        if column == 0:
            panel.set_ylabel(f"time of a {kind} ray")
    handles = [pyplot.Line2D([], [], linestyle="", marker=marker, color=color, label=name)
               for name, color, marker in FAMILIES]
    figure.legend(handles=handles, loc="lower center", ncol=5, frameon=False, fontsize=9,
                  title="both axes relative to the mean of the scene's binary BVHs", title_fontsize=9)
    path = os.path.join(folder, "measures.png")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("files", nargs="+", metavar="FILE", help="JSON of boxwood bench")
    parser.add_argument("-o", "--output", default=".", metavar="FOLDER", help="where the pictures go (default: .)")
    arguments = parser.parse_args()
    try:
        import matplotlib
    except ImportError:
        print("plots.py: matplotlib is missing (Debian: apt-get install python3-matplotlib)", file=sys.stderr)
        return 1
    matplotlib.use("Agg")
    from matplotlib import pyplot
    rows = read_rows(arguments.files)
    errors = error_rows(rows.get("bench error", []))
    suites = {"bench amortize": draw_amortize, "bench refit": draw_refit, "bench peers": plots_peers.draw_peers,
              "bench builds": plots_peers.draw_builds, "bench scale": plots_peers.draw_scale,
              "bench measures": lambda *drawn: draw_measures(*drawn[:2], rows.get("predictions", []), drawn[2])}
    if not errors and not any(rows.get(suite) for suite in suites):
        print("plots.py: no rows of a suite that it draws in the files", file=sys.stderr)
        return 3
    os.makedirs(arguments.output, exist_ok=True)
    if errors:
        Plots(pyplot, errors, arguments.output).draw()
    for suite, draw in suites.items():
        if rows.get(suite):
            draw(pyplot, rows[suite], arguments.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())

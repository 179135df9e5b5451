"""Pictures of `boxwood bench peers`, `builds` and `scale`; plots.py calls them."""
import os

MARKERS = "oD^vP*X"
LINES = "#555555"


def of_boxwood(row):
    return "recipe" in row


def named(row):
    """A contestant for a legend: one of Boxwood's by its recipe, and whether it is the renderer."""
    return row["contestant"].replace("boxwood:", "").replace(" packets16", "")


def thread_words(count):
    return "1 thread" if count == 1 else f"{count} threads"


def size_words(count):
    """1,999,232 as 2M."""
    return f"{count / 1e6:.3g}M" if count >= 999_000 else f"{count / 1e3:.3g}k"


def file_of(scene):
    return os.path.basename(scene)


def save(pyplot, figure, axes, path, columns=3):
    """With one legend below all panels."""
    entries = {}
    for panel in axes:
        for handle, label in zip(*panel.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    lines = -(-len(entries) // columns)
    figure.tight_layout(rect=(0, (0.25 + 0.23 * lines) / figure.get_figheight(), 1, 1))
    figure.legend(entries.values(), entries.keys(), loc="lower center", ncol=columns, frameon=False, fontsize=9)
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
    print(path)


def bars_of_ratios(panel, rows, scenes, recipes):
    """Bars of Boxwood's exact mode, marks of its fast mode and of the peers."""
    shown = [recipe for recipe in recipes if any(named(row) == recipe for row in rows)]
    width = 0.8 / len(shown)
    for place, recipe in enumerate(shown):
        for mode in ("exact", "fast"):
            own = [row for row in rows if of_boxwood(row) and named(row) == recipe and row["mode"] == mode
                   and row["ratio"] is not None]
            if not own:
                continue
            x = [scenes.index(row["scene"]) - 0.4 + width * (place + 0.5) for row in own]
            y = [row["ratio"] for row in own]
            if mode == "exact":
                spread = [[row["ratio"] - row["ratio_low"] for row in own],
                          [row["ratio_high"] - row["ratio"] for row in own]]
                panel.bar(x, y, width * 0.92, color=f"C{recipes.index(recipe) % 10}",
                          label=f"{recipe}, exact")
                panel.errorbar(x, y, yerr=[[max(part, 0.0) for part in side] for side in spread],
                               fmt="none", ecolor="#222222", elinewidth=1.0, capsize=2)
            else:
                panel.plot(x, y, linestyle="", marker="_", markersize=max(5.0, 30 * width), markeredgewidth=1.6,
                           color="#222222", label="fast mode")
    peers = sorted({named(row) for row in rows if not of_boxwood(row)})
    for place, peer in enumerate(peers):
        own = [row for row in rows if not of_boxwood(row) and named(row) == peer]
        panel.plot([scenes.index(row["scene"]) + 0.06 * (place - (len(peers) - 1) / 2) for row in own],
                   [row["ratio"] for row in own], linestyle="", marker=MARKERS[place % len(MARKERS)],
                   markersize=5, markerfacecolor="white", markeredgecolor="#333333", label=peer, zorder=4)


def draw_peers(pyplot, rows, folder):
    rows = [row for row in rows if row["ratio"] is not None]
    for threads in sorted({row["threads"] for row in rows}):
        own = [row for row in rows if row["threads"] == threads]
        kinds = list(dict.fromkeys(row["rays_kind"] for row in own))
        scenes = list(dict.fromkeys(row["scene"] for row in own))
        recipes = list(dict.fromkeys(named(row) for row in own if of_boxwood(row)))
        if not recipes:
            continue
        width = max(8.0, 1.5 + len(scenes) * (0.5 + 0.3 * len(recipes)))
        figure, axes = pyplot.subplots(len(kinds), 1, squeeze=False, figsize=(width, 2.7 * len(kinds) + 1.6))
        axes = [row[0] for row in axes]
        for panel, kind in zip(axes, kinds):
            bars_of_ratios(panel, [row for row in own if row["rays_kind"] == kind], scenes, recipes)
            for level, style in ((1.0, "-"), (0.9, ":"), (1.2, "--")):
                panel.axhline(level, color=LINES, linewidth=0.9, linestyle=style, zorder=0)
            panel.set_title("primary rays in packets" if kind.endswith("packets") else f"{kind} rays",
                            fontsize=10)
            panel.set_ylabel("rate / best Embree's")
            panel.set_ylim(bottom=0)
            panel.set_xlim(-0.6, len(scenes) - 0.4)
            panel.set_xticks(range(len(scenes)))
            panel.set_xticklabels([])
            panel.grid(True, axis="y", color="#dddddd", linewidth=0.6)
            panel.set_axisbelow(True)
        axes[-1].set_xticklabels([file_of(scene) for scene in scenes], rotation=20, ha="right")
        figure.suptitle(f"Rays per second over the best Embree variant's, {thread_words(threads)} "
                        "(lines: 0.9, 1, 1.2)", fontsize=11)
        save(pyplot, figure, axes, os.path.join(folder, f"peers-{threads}.png"))


def draw_builds(pyplot, rows, folder):
    for scene in dict.fromkeys(row["scene"] for row in rows):
        own = [row for row in rows if row["scene"] == scene]
        contestants = list(dict.fromkeys(row["contestant"] for row in own))
        counts = sorted({row["threads"] for row in own})
        figure, axes = pyplot.subplots(1, 1, figsize=(9, 1.8 + 0.34 * len(contestants) * len(counts)))
        height = 0.8 / len(counts)
        for place, threads in enumerate(counts):
            for row in own:
                if row["threads"] != threads:
                    continue
                y = contestants.index(row["contestant"]) - 0.4 + height * (place + 0.5)
                color = f"C{place}" if of_boxwood(row) else "#999999"
                label = thread_words(threads) if of_boxwood(row) else None
                axes.barh(y, row["build_ms"], height * 0.9, color=color, alpha=1 - 0.35 * place, label=label)
                axes.text(row["build_ms"], y, f" {row['build_ms']:,.0f}", va="center", fontsize=8)
        axes.set_yticks(range(len(contestants)))
        axes.set_yticklabels([name.replace("boxwood:", "") for name in contestants], fontsize=9)
        axes.invert_yaxis()
        axes.set_xlabel("build, milliseconds (median)")
        axes.margins(x=0.12)
        axes.grid(True, axis="x", color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
        axes.set_title(f"{file_of(scene)}: {own[0]['triangles']:,} triangles", fontsize=11)
        name = "".join(c if c.isalnum() or c in "-_." else "_" for c in file_of(scene))
        save(pyplot, figure, [axes], os.path.join(folder, f"builds-{name}.png"))


def draw_scale(pyplot, rows, folder):
    for threads in sorted({row["threads"] for row in rows}):
        own = [row for row in rows if row["threads"] == threads]
        kinds = list(dict.fromkeys(row["rays_kind"] for row in own))
        contestants = list(dict.fromkeys(row["contestant"] for row in own))
        panels = [("build_ns_per_triangle", kinds[0], "build, ns per triangle"),
                  ("bytes_per_triangle", kinds[0], "bytes per triangle")]
        panels += [("mrays_by_log2", kind, f"{kind}: million rays per second x log2 N") for kind in kinds]
        figure, axes = pyplot.subplots(2, 2 if len(kinds) < 3 else 3, squeeze=False, figsize=(11, 8.4))
        axes = [panel for line in axes for panel in line]
        for panel, (key, kind, label) in zip(axes, panels):
            for place, contestant in enumerate(contestants):
                line = sorted((row for row in own if row["contestant"] == contestant and row["rays_kind"] == kind),
                              key=lambda row: row["triangles"])
                if line:
                    panel.plot([row["triangles"] for row in line], [row[key] for row in line],
                               marker=MARKERS[place % len(MARKERS)], markersize=5, color=f"C{place % 10}",
                               linestyle="-" if of_boxwood(line[0]) else "--", label=named(line[0]))
            panel.set_xscale("log")
            sizes = sorted({row["triangles"] for row in own})
            panel.set_xticks(sizes)
            panel.set_xticks([], minor=True)
            panel.set_xticklabels([size_words(size) for size in sizes])
            panel.set_xlabel("triangles N")
            panel.set_ylabel(label)
            panel.set_ylim(bottom=0)
            panel.grid(True, color="#dddddd", linewidth=0.6)
            panel.set_axisbelow(True)
        for panel in axes[len(panels):]:
            panel.set_visible(False)
        figure.suptitle(f"Terrain in growing sizes, {thread_words(threads)}", fontsize=11)
        save(pyplot, figure, axes[:len(panels)], os.path.join(folder, f"scale-{threads}.png"))

"""Draws a chart with matplotlib as SVG or PNG, and writes its data as CSV.

A chart's axes fill the picture; titles, legend and labels of marks lie around them, and saving takes them in. So no label covers a curve,
and every axis has the same length on paper. Text stays text, which a PDF keeps searchable. Clouds and meshes are one path for each colour,
in relative tenths of a point: smaller than an image, and sharp."""
from __future__ import annotations

import io
import re
import textwrap
import unicodedata
import warnings
from collections.abc import Iterator, Sequence
from typing import Any

import matplotlib  # type: ignore[import]
import numpy as np
from matplotlib import cm, lines, ticker
from matplotlib.colors import ListedColormap, Normalize  # type: ignore[import]
from matplotlib.figure import Figure as Sheet  # type: ignore[import]
from matplotlib.patches import PathPatch  # type: ignore[import]
from matplotlib.path import Path as Outline  # type: ignore[import]
from numpy.typing import NDArray

from .chart import Chart, Field, Numbers, Series

Array = NDArray[np.float64]

PX = 1 / 96  #: [inch]; matplotlib's own unit, the point, is 0.75 px
# distinguishable with colour blindness (Okabe and Ito, then Tol)
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#117733", "#000000", "#882255", "#999933", "#332288", "#aa4499")
_EARTHS = ("#b08d57", "#d9c9a5", "#8c8c7a", "#c2b280", "#a3a380")
_DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)), (0, (5, 2, 1, 2)))  # after the last colour they tell series apart
_MOST_ENTRIES = 24  # of a legend; more than a page can hold are counted only
_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans", "font.size": 10, "axes.titlesize": 12, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.edgecolor": "#333", "axes.linewidth": 0.8, "axes.axisbelow": True, "axes.grid": True, "grid.color": "#ddd", "grid.linewidth": 0.8,
    "text.color": "#222", "axes.labelcolor": "#222", "legend.frameon": False, "lines.linewidth": 1.4, "lines.markersize": 6,
    "xtick.major.size": 0, "ytick.major.size": 0, "xtick.minor.size": 0, "ytick.minor.size": 0, "text.parse_math": False, "svg.fonttype": "none"}

_ROOM = "\u2002"  # behind each letter of Chinese, Japanese and Korean, which matplotlib's font lacks and measures as narrower than it is
_CIRCLE = Outline.unit_circle()
_UP = Outline([(0, 1.75), (0, 4), (-0.9, 3.1), (0, 4), (0.9, 3.1)])  # an arrow above the circle


def as_svg(chart: Chart) -> str:
    """Self-contained, the same for the same chart. Raises ValueError for numbers without a place on their axis, columns of unequal
    length, and a chart without data."""
    svg = _saved(chart, format="svg", metadata={"Date": None}).decode()
    svg = re.sub(r"<metadata>.*?</metadata>|<defs>\s*<style.*?</defs>|<!--.*?-->", "", svg[svg.index("<svg"):], flags=re.DOTALL)
    svg = re.sub(r"font: (?:(\d+) )?([\d.]+)px [^;\"]*", r"font-size: \2; font-weight: \1", svg)  # WeasyPrint reads no shorthand
    svg = re.sub(r' style="([^"]*)"', lambda found: "".join(f' {name}="{value}"' for name, value in re.findall(r"([a-z-]+): ([^;]+)", found[1])), svg)
    svg = re.sub(r'(?<= d=")[^"CQ]*(?=")', lambda found: _short_path(found[0]), svg)
    svg = re.sub(r'(?<=<g) id="[^"]*"| transform="rotate\(-0 [^"]*"|(?<=\n)\s+', "", svg)  # nothing refers to these ids, and a page has many pictures
    look = 'stroke-linejoin="round" fill="#222" font-family="DejaVu Sans, Helvetica, Arial, sans-serif"'
    return svg.replace(_ROOM, "").replace("xlink:href=", "href=").replace('xmlns:xlink="http://www.w3.org/1999/xlink"', look, 1)


def _text(words: str, columns: int = 60) -> str:
    """Broken into lines of at most `columns`."""
    return textwrap.fill("".join(each + _ROOM if unicodedata.east_asian_width(each) in "WF" else each for each in words), columns)


def _short_path(path: str) -> str:
    """Tenths of a point, relative to the place before. Each corner is rounded alone, so that errors do not add up."""
    out, at, start = [], (0, 0), (0, 0)
    for command, x, y in re.findall(r"([MLz])(?: (\S+) (\S+))?", path):
        if command == "z":
            out.append("z")
            at = start
            continue
        place = round(10 * float(x)), round(10 * float(y))
        dx, dy = place[0] - at[0], place[1] - at[1]
        out.append(f"{command.lower()}{dx / 10:g} {dy / 10:g}".replace(" -", "-") if dx or dy or command == "M" else "h0")
        at = place
        if command == "M":
            start = at
    return "".join(out)


def as_png(chart: Chart, dots_per_inch: int = 192) -> bytes:
    """Two dots for each pixel of the SVG. Raises as as_svg does."""
    return _saved(chart, format="png", dpi=dots_per_inch)


def as_csv(chart: Chart) -> str:
    """Columns series, x, y (headed by the axes' labels), one row per point, all digits; where known, certainty, error and the two ends
    of a range. A chart with a field instead has x and y of each corner and the value, one row per polygon."""
    _check_columns(chart)
    if chart.field:
        return _csv_of_field(chart.field)
    told = any(len(each.certainty) for each in chart.series)
    errors = any(len(each.error) for each in chart.series)
    ranges = any(len(each.low) for each in chart.series)
    heads = ["series", quoted(chart.x.label), quoted(chart.y.label), *['"certainty"'] * told, *['"error"'] * errors, *['"low"', '"high"'] * ranges]
    rows = [",".join(heads)]
    for each in chart.series:
        columns: list[Sequence[str]] = [[quoted(each.name)] * len(each.x), _exact(each.x), _exact(each.y)]
        unknown = [""] * len(each.x)
        if told:
            columns.append([quoted(one) for one in each.certainty or ["certain"] * len(each.x)])
        for values in [each.error] * errors + [each.low, each.high] * ranges:
            columns.append(_exact(values) if len(values) else unknown)
        rows += [",".join(row) for row in zip(*columns)]
    return "\n".join(rows) + "\n"


def quoted(text: str) -> str:
    """A CSV cell of text."""
    return '"' + text.replace('"', '""') + '"'


def _exact(values: Numbers) -> list[str]:
    """Shortest texts that read back as the same numbers; "" for NaN."""
    return ["" if value != value else repr(float(value)).removesuffix(".0") for value in values]


def _csv_of_field(field: Field) -> str:
    numbers = [str(k + 1) if field.corners > 1 else "" for k in range(field.corners)]
    places = np.stack([np.reshape(field.x, (-1, field.corners)), np.reshape(field.y, (-1, field.corners))], axis=2)
    rows = [",".join([f"x{k} [m],y{k} [m]" for k in numbers] + [quoted(field.label)])]
    rows += [",".join(_exact([*place.ravel(), value])) for place, value in zip(places, field.value)]
    return "\n".join(rows) + "\n"


def _check_columns(chart: Chart) -> None:
    for each in chart.series:
        for what, values in (("y", each.y), ("certainty", each.certainty), ("error", each.error), ("low", each.low), ("high", each.high)):
            if len(values) != len(each.x) and (len(values) > 0 or what == "y"):
                raise ValueError(f'"{each.name}" has {len(each.x)} values of x and {len(values)} of {what}; give one for each point')
        if len(each.low) != len(each.high):
            raise ValueError(f'"{each.name}" has {len(each.low)} lower ends of its range and {len(each.high)} upper ones')
        if each.style in ("segments", "bars") and len(each.x) % 2:
            raise ValueError(f'"{each.name}" has {len(each.x)} ends of segments; give two for each segment')
    if chart.field and not len(chart.field.x) == len(chart.field.y) == chart.field.corners * len(chart.field.value):
        raise ValueError(f'"{chart.field.label}" has {len(chart.field.value)} values and {len(chart.field.x)} corners; '
                         f"give {chart.field.corners} for each value")


# ---------------------------------------------------------------- layout


def _limits(chart: Chart, at: str) -> tuple[float, float]:
    """All that is drawn, and a margin."""
    axis = chart.x if at == "x" else chart.y
    if axis.names:
        return -0.6, len(axis.names) - 0.4
    if at == "x" and axis.shown:
        return axis.shown
    drawn: list[Series | Field] = [*chart.series, *filter(None, [chart.field])]
    parts = [np.asarray(each.x if at == "x" else each.y, np.float64) for each in drawn]
    if at == "y":
        for each in chart.series:
            y, error = np.asarray(each.y, float), np.asarray(each.error, float)
            ends = [y - error, y + error] if error.size else []
            parts += [part[~np.isnan(part)] for part in [*ends, np.asarray(each.low, float), np.asarray(each.high, float)]]
    values = np.concatenate([*parts, [mark.value for mark in chart.marks if mark.at == at]])
    if not values.size:
        raise ValueError(f'"{chart.title}" is a chart without data')
    if not np.isfinite(values).all() or (axis.logarithmic and values.min() <= 0.0):
        raise ValueError(f'"{chart.title}" has a value that has no place on its axis {at}')
    low, high = float(values.min()), float(values.max())
    if axis.logarithmic:
        return low / 1.2, high * 1.2
    margin = 0.04 * (high - low) or 0.1 * abs(high) or 1.0
    return low - margin, high + margin


def _size(chart: Chart, x: tuple[float, float], y: tuple[float, float]) -> tuple[float, float, int]:
    """Width and height of the axes [px], and the exaggeration of heights."""
    if not chart.equal:
        return 480, 60 + 34 * len(chart.y.names) if chart.y.names else 240, 1
    scale = min(860 / (x[1] - x[0]), 360 / (y[1] - y[0]))
    width, height = scale * (x[1] - x[0]), scale * (y[1] - y[0])
    times = max(1, int(np.ceil(chart.least_height / height))) if width > 300 else 1
    return width, height * times, times


def _saved(chart: Chart, **how: Any) -> bytes:
    _check_columns(chart)
    x, y = _limits(chart, "x"), _limits(chart, "y")
    width, height, times = _size(chart, x, y)
    with matplotlib.rc_context({**_STYLE, "svg.hashsalt": chart.title}), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph")  # the page's fonts have what matplotlib's lack
        sheet = Sheet((width * PX, height * PX))
        axes = sheet.add_axes((0, 0, 1, 1), xlim=x, ylim=y, xscale="log" if chart.x.logarithmic else "linear",
                              yscale="log" if chart.y.logarithmic else "linear")
        axes.set_xlabel(_text(chart.x.label))
        axes.set_ylabel(_text(chart.y.label + (f", heights x {times}" if times > 1 else ""), 50))
        _ticks(axes.xaxis, chart.x.logarithmic, x, width)
        _ticks(axes.yaxis, chart.y.logarithmic, y, height)
        for axis, names, tilt in ((axes.xaxis, chart.x.names, 25), (axes.yaxis, chart.y.names, 0)):
            if names:
                axis.set_ticks(range(len(names)), [_text(each, 26) for each in names], rotation=tilt, ha="right")
                axes.grid(False, axis=axis.axis_name)
        if chart.field:
            _draw_field(axes, chart.field, _dot_size(chart, width * height))
        colours = list(_looks(chart))
        for order, (each, look) in enumerate(zip(chart.series, colours)):
            _draw(axes, each, dict(look, zorder=2 + 0.001 * order), _dot_size(chart, width * height))
        axes.set_title(_text(chart.title, 90), pad=6 + 13 * _draw_marks(axes, chart))
        _draw_legend(axes, chart, colours)
        file = io.BytesIO()
        sheet.savefig(file, bbox_inches="tight", pad_inches=0.08, **how)
    return file.getvalue()


def _ticks(axis: Any, logarithmic: bool, limits: tuple[float, float], length: float) -> None:
    """Plain numbers; on a logarithmic axis powers of ten, within a few decades also their 2 and 5 folds."""
    axis.set_minor_locator(ticker.NullLocator())
    if logarithmic and limits[1] / limits[0] > 5:
        axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if limits[1] / limits[0] < 2e3 else (1,)))
    else:
        axis.set_major_locator(ticker.MaxNLocator(int(np.clip(length / 45, 3, 10)), steps=[1, 2, 5, 10]))
    axis.set_major_formatter(lambda value, _: f"{value + 0.0:.6g}")


def _looks(chart: Chart) -> Iterator[dict[str, Any]]:
    """Areas have earth colours, so that a line never looks like the ground that it crosses; meshes are grey."""
    looks: list[dict[str, Any]] = []
    areas = others = 0
    for each in chart.series:
        look: dict[str, Any] = {"color": "#555"}
        if each.like is not None:
            look = looks[each.like]
        elif each.style == "area":
            look, areas = {"color": _EARTHS[areas % len(_EARTHS)]}, areas + 1
        elif each.style != "segments":
            look, others = {"color": _COLOURS[others % len(_COLOURS)], "linestyle": _DASHES[others // len(_COLOURS) % len(_DASHES)]}, others + 1
        looks.append(look)
        yield look


def _dot_size(chart: Chart, area: float) -> float:
    """Diameter [px]: dots nearly touch where they are dense."""
    dots = sum(len(each.x) for each in chart.series if each.style == "dots")
    dots += len(chart.field.value) if chart.field and chart.field.corners == 1 else 0
    return float(np.clip(0.75 * np.sqrt(area / max(1, dots)), 2, 6))


# ---------------------------------------------------------------- what is drawn


def _draw_field(axes: Any, field: Field, dot: float) -> None:
    places = np.stack([field.x, field.y], axis=1).reshape(-1, field.corners, 2)
    colours = ListedColormap(matplotlib.colormaps["YlGnBu"](np.linspace(0.1, 1, 40)))  # dark is much, in print too; the eye tells no more apart
    scale = cm.ScalarMappable(Normalize(field.low, field.high, clip=True), colours)
    shades = scale.to_rgba(np.asarray(field.value, float))
    for shade in np.unique(shades, axis=0):
        _draw_pieces(axes, places[(shades == shade).all(axis=1)], dot if field.corners == 1 else 0.4, shade, 1, fill=field.corners > 1)
    width, height = (side / axes.figure.dpi / PX for side in (axes.bbox.width, axes.bbox.height))
    long = min(1.0, max(0.45, 270 / width))  # a share: labels need some room
    bar = axes.figure.colorbar(scale, cax=axes.inset_axes((0, -80 / height, long, 14 / height)), orientation="horizontal")
    bar.solids.set_edgecolor("face")
    bar.ax.grid(False)
    _ticks(bar.ax.xaxis, False, (field.low, field.high), 0.8 * long * width)
    bar.ax.annotate(_text(field.label), (1, 0.5), xytext=(10, 0), xycoords="axes fraction", textcoords="offset points", va="center")


def _draw_pieces(axes: Any, pieces: Array, width: float, colour: Any, order: float, fill: bool = False, **look: Any) -> None:
    """Dots, segments or polygons as one path. pieces: [n, corners, 2]; width: of the line, or of a dot [px]."""
    if dots := pieces.shape[1] == 1:
        pieces = np.repeat(pieces, 2, axis=1)
        pieces[:, 1, 0] += 1e-6 * np.ptp(axes.get_xlim())  # some writers do not draw a line without length
    codes = [Outline.MOVETO] + [Outline.LINETO] * (pieces.shape[1] - 1)
    if fill:
        pieces, codes = np.concatenate([pieces, pieces[:, :1]], axis=1), [*codes, Outline.CLOSEPOLY]
    outline = Outline(pieces.reshape(-1, 2), codes * len(pieces))
    outline.should_simplify = False
    look = {"capstyle": "round", "joinstyle": "round", "antialiased": not dots, **look}  # a PNG of sharp dots is a tenth as large
    axes.add_artist(PathPatch(outline, facecolor=colour if fill else "none", edgecolor=colour, linewidth=0.75 * width, zorder=order, **look))


def _area(diameter: float) -> float:
    """Of a marker, as scatter wants it [pt²]."""
    return (0.75 * diameter) ** 2


def _draw(axes: Any, series: Series, look: dict[str, Any], dot: float) -> None:
    x, y = np.asarray(series.x, float), np.asarray(series.y, float)
    colour, order = look["color"], look["zorder"]
    if series.style == "area":
        axes.fill(x, y, facecolor=colour, alpha=0.55, edgecolor="#777", zorder=order)
    elif series.style in ("dots", "segments", "bars"):
        pieces = np.stack([x, y], axis=1).reshape(-1, 1 if series.style == "dots" else 2, 2)
        how: dict[str, Any] = {"alpha": 0.75, "capstyle": "butt"} if series.style == "bars" else {}
        _draw_pieces(axes, pieces, {"dots": dot, "segments": 0.5, "bars": 18}[series.style], colour, order, **how)
    else:
        if len(series.low):
            axes.fill_between(x, series.low, series.high, color=colour, alpha=0.16, linewidth=0, zorder=order)
        if len(series.error):
            low, high = y - series.error, y + np.asarray(series.error)
            axes.vlines(x, low, high, color=colour, alpha=0.7, linewidth=0.8, zorder=order)
            if series.style != "points":
                axes.fill_between(x, low, high, color=colour, alpha=0.16, linewidth=0, zorder=order)
        if series.style != "points":
            axes.plot(x, y, **look)
        if series.style != "line":
            certainty = np.asarray(series.certainty or ["certain"] * len(x))
            for kind in ("certain", "lower bound", "questionable"):
                if (certainty == kind).any():
                    _draw_points(axes, x[certainty == kind], y[certainty == kind], kind, colour, order)


def _draw_points(axes: Any, x: Any, y: Any, certainty: str, colour: str, order: float = 2) -> Any:
    """Filled; a lower bound hollow with an arrow upwards; questionable hollow and dashed. Gives what a legend shows."""
    if certainty == "lower bound":
        up = axes.scatter(x, y, marker=_UP, s=_area(32), facecolors="none", edgecolors=colour, linewidths=1.3, zorder=order, clip_on=False)
        return up, _draw_points(axes, x, y, "", colour, order)
    return axes.scatter(x, y, marker=_CIRCLE, s=_area(7), facecolors=colour if certainty == "certain" else "#fff", edgecolors=colour,
                        linewidths=1.4, linestyles=(0, (1.6, 1.0)) if certainty == "questionable" else "-", zorder=order, clip_on=False)


def _draw_marks(axes: Any, chart: Chart) -> int:
    """Labels lie outside the axes: of vertical marks above them, in as many rows as they need; of horizontal ones on the right. Gives
    the number of rows."""
    to_px = 1 / axes.figure.dpi / PX

    def extent(text: Any) -> float:
        return float(text.get_window_extent().width * to_px)

    begins: list[float] = []  # of each row, its leftmost label
    for mark in sorted((each for each in chart.marks if each.at == "x"), key=lambda each: -each.value):
        place = float(axes.transData.transform((mark.value, axes.get_ylim()[0]))[0] * to_px)
        text = axes.annotate(_text(mark.label, 200), (mark.value, 1), xycoords=("data", "axes fraction"), textcoords="offset points", xytext=(0, 0))
        end = place + extent(text) + 8
        row = next((k for k, begin in enumerate(begins) if end < begin), len(begins))
        begins[row:row + 1] = [place]
        text.xyann = (2, 4 + 13 * row)
        axes.plot([mark.value] * 2, [0, 1 + (13 * row + 3) / 0.75 / (axes.bbox.height * to_px)], transform=axes.get_xaxis_transform(),
                  color="#333", linestyle=(0, (6, 4)), linewidth=0.8, clip_on=False, zorder=3)
    last = -np.inf
    for mark in sorted((each for each in chart.marks if each.at == "y"), key=lambda each: each.value):
        place = float(axes.transData.transform((axes.get_xlim()[0], mark.value))[1] * to_px)
        last = max(place, last + 16)
        axes.annotate(_text(mark.label, 200), (1, mark.value), xycoords=("axes fraction", "data"), textcoords="offset points",
                      xytext=(5, 0.75 * (last - place)), va="center")
        axes.axhline(mark.value, color="#333", linestyle=(0, (6, 4)), linewidth=0.8, zorder=3)
    return len(begins)


def _draw_legend(axes: Any, chart: Chart, looks: list[dict[str, Any]]) -> None:
    """Below the axes, in as many columns as fit: so two charts fit beside one another on a page."""
    line: dict[str, Any] = {"linewidth": 3}
    point: dict[str, Any] = {"marker": "o", "linestyle": ""}
    entries = [(lines.Line2D([], [], **{**look, **(point if each.style == "points" else line)}), each.name)
               for each, look in zip(chart.series, looks) if each.like is None and each.style not in ("area", "segments")]
    if len(entries) > _MOST_ENTRIES:
        entries[_MOST_ENTRIES:] = [(lines.Line2D([], [], alpha=0), f"and {len(entries) - _MOST_ENTRIES} more")]
    for kind in ("lower bound", "questionable"):
        if any(kind in each.certainty for each in chart.series):
            entries.append((_draw_points(axes, np.nan, np.nan, kind, "#333"), kind))
    if not entries:
        return
    width, height = (side / axes.figure.dpi / PX for side in (axes.bbox.width, axes.bbox.height))
    handles, names = zip(*[(handle, _text(name, 60)) for handle, name in entries])
    how: dict[str, Any] = {"loc": "upper left", "borderaxespad": 0, "handlelength": 1.6, "scatterpoints": 1, "scatteryoffsets": [0.3]}
    below = (-122 if chart.field else -54 if chart.x.label else -34) / height
    longest = max(len(line) for name in names for line in name.split("\n"))
    axes.legend(handles, names, bbox_to_anchor=(0, below), ncol=max(1, int(width / (7.5 * longest + 60))), columnspacing=1.5, **how)

// The parts of a plot: curves, marks on the abscissa, verticals, levels, bands, and the legend. Each uses the plot's scales: px(x), py(y),
// left, width, height.
import { element, svg } from "./dom.js";
import { looks } from "./flags.js";
import { number } from "./format.js";
import { thinned } from "./plot_scale.js";

export const margin = { right: 14, top: 12, bottom: 46 }; // bottom: more where ticks have long names, see plot.bottom
const label_width = 15; // verticals closer than this share one label [px]

const marker_shapes = ["M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0", "M-4,-4h8v8h-8z", "M0,-5.5L5,3.5H-5z", "M0,-5.5L5,0L0,5.5L-5,0z",
                       "M0,5.5L5,-3.5H-5z", "M-5.5,-2.2h11v4.4h-11z",
                       "M-1.8,-5.2h3.6v3.4h3.4v3.6h-3.4v3.4h-3.6v-3.4h-3.4v-3.6h3.4z",
                       "M0,-6L1.5,-2L5.7,-1.9L2.4,.8L3.5,4.9L0,2.5L-3.5,4.9L-2.4,.8L-5.7,-1.9L-1.5,-2z",
                       "M-5.5,0L3.5,-5V5z", "M5.5,0L-3.5,-5V5z", "M-4.5,-5H4.5L-4.5,5H4.5z",
                       "M0,-2.4L2.9,-5.3L5.3,-2.9L2.4,0L5.3,2.9L2.9,5.3L0,2.4L-2.9,5.3L-5.3,2.9L-2.4,0L-5.3,-2.9L-2.9,-5.3z"];
const arrow_shape = "M0,-7V-16M-3.5,-12.5L0,-16L3.5,-12.5"; // lower bound: an arrow upwards from a marker
const mark_shapes = {
    failed: "M-5,-5L5,5M-5,5L5,-5",
    skipped: "M-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0M-3.5,3.5L3.5,-3.5",
    pending: "M0,-4V4",
    running: "M-3,-5L5,0L-3,5z",
};
export const series_colours = 12;
export const series_class = (index) => `series-${index % series_colours}`;
/// After the last colour the colours repeat with other shapes.
const shape_of = (index) => marker_shapes[(index + 5 * Math.floor(index / series_colours)) % marker_shapes.length];

export function curve(plot, data, index) {
    const kept = data.points ? data.x.map((_, i) => i) : thinned(data.x, data.y, plot.width);
    const drawn = kept.filter((i) => Number.isFinite(data.y[i]) && Number.isFinite(data.x[i]));
    const parts = error_parts(plot, data, index, drawn);
    if (!data.scatter) parts.push(svg("path", { class: `curve ${series_class(index)}`, d: path_of(plot, data, kept) }));
    if (!data.points) return parts;
    return [...parts, ...drawn.flatMap((i) => marker(data, index, i, `translate(${plot.px(data.x[i])},${plot.py(data.y[i])})`))];
}

/// Half the error band at a point; null: unknown.
export const error_at = (data, i) => (Number.isFinite(data.errors?.[i]) && Number.isFinite(data.y[i]) ? data.errors[i] : null);

/// Both ends of the band at a point, from its error or its range; null: unknown.
export function ends_at(data, i) {
    if (Number.isFinite(data.low?.[i]) && Number.isFinite(data.high?.[i])) return [data.low[i], data.high[i]];
    const error = error_at(data, i);
    return error === null ? null : [data.y[i] - error, data.y[i] + error];
}

/// A whisker at each point with a known error, and a band between neighbours that both have one. Ranges have no whiskers.
function error_parts(plot, data, index, drawn) {
    const at = (i, side) => `${plot.px(data.x[i]).toFixed(1)},${plot.py(ends_at(data, i)[side]).toFixed(1)}`;
    const known = new Set(drawn.filter((i) => ends_at(data, i) !== null));
    const parts = [...known].filter(() => data.errors).map((i) => svg("path", { class: `whisker ${series_class(index)}`, d: `M${at(i, 0)}L${at(i, 1)}` }));
    if (data.scatter) return parts;
    const pairs = drawn.slice(1).map((i, k) => [drawn[k], i]).filter(([a, b]) => known.has(a) && known.has(b));
    const band = pairs.map(([a, b]) => `M${at(a, 1)}L${at(b, 1)}L${at(b, 0)}L${at(a, 0)}Z`).join("");
    return band ? [svg("path", { class: `error-band ${series_class(index)}`, d: band }), ...parts] : parts;
}

/// One point in the style of its look, with its note as a title.
function marker(data, index, i, transform) {
    const look = data.looks?.[i] ?? "";
    const note = data.notes?.[i] ? [svg("title", {}, data.notes[i])] : [];
    return marker_parts(series_class(index), shape_of(index), look, transform, note);
}

function marker_parts(series, shape, look, transform, note = []) {
    const parts = [svg("path", { class: `marker ${series} ${look}`.trim(), d: shape, transform }, ...note)];
    if (look.includes("bound")) parts.push(svg("path", { class: `arrow ${series}`, d: arrow_shape, transform }));
    return parts;
}

function path_of(plot, data, kept) {
    let path = "";
    let drawing = false;
    for (const i of kept) {
        const y = data.y[i];
        if (y === null || !Number.isFinite(y)) {
            drawing = false;
            continue;
        }
        path += `${drawing ? "L" : "M"}${plot.px(data.x[i]).toFixed(1)},${plot.py(y).toFixed(1)}`;
        drawing = true;
    }
    return path;
}

export function mark(plot, { x, kind, label }) {
    const at = plot.height - plot.bottom - 9;
    return svg("path", { class: `mark ${kind}`, d: mark_shapes[kind], transform: `translate(${plot.px(x)},${at})` },
               svg("title", {}, label));
}

/// Verticals and their texts; joins the texts of neighbours.
export function verticals(plot, lines) {
    const bottom = plot.height - plot.bottom;
    const parts = lines.map((line) => svg("path", { class: `event ${line.kind ?? ""}`, d: `M${plot.px(line.x)},${margin.top}V${bottom}` },
                                          svg("title", {}, line.label)));
    const groups = [];
    for (const line of lines.filter(({ text }) => text).sort((a, b) => a.x - b.x)) {
        const at = plot.px(line.x);
        const last = groups.at(-1);
        if (!last || at - last.at > label_width) groups.push({ at, texts: [line.text] });
        else if (!last.texts.includes(line.text)) last.texts.push(line.text);
    }
    for (const { at, texts } of groups) {
        const beside = at - plot.left < label_width ? at + 12 : at - 4;
        parts.push(svg("text", { class: "event-text", transform: `translate(${beside},${margin.top + 3}) rotate(-90)`,
                                 "text-anchor": "end" }, texts.join(", ")));
    }
    return parts;
}

/// A horizontal line at a value; if the value is outside the picture, a label at the edge.
export function level(plot, { y, label }, index) {
    const right = plot.width - margin.right;
    const [low, high] = plot.y_range;
    const outside = y > high ? "▲ " : y < low ? "▼ " : "";
    const at = plot.py(Math.min(high, Math.max(low, y)));
    const above = at > margin.top + 20;
    const text = svg("text", { class: "level-text", x: plot.left + 6 + 8 * (index % 4), y: above ? at - 5 : at + 15 },
                     `${outside}${label} ${number(y)}`);
    return outside ? [text] : [svg("path", { class: "level", d: `M${plot.left},${at}H${right}` }), text];
}

/// A shaded range of the abscissa, with its name at the top.
export function band(plot, { from, to, label, kind }, index) {
    const clamp = (x) => Math.min(plot.x_range[1], Math.max(plot.x_range[0], x));
    const [left, right] = [plot.px(clamp(from)), plot.px(clamp(to))];
    const bottom = plot.height - plot.bottom;
    return [svg("rect", { class: `band ${kind}`, x: left, y: margin.top, width: Math.max(right - left, 1), height: bottom - margin.top },
                svg("title", {}, `${label}: ${number(from)} to ${number(to)}`)),
            svg("path", { class: `band-edge ${kind}`, d: `M${left},${margin.top}V${bottom}M${right},${margin.top}V${bottom}` }),
            svg("text", { class: "band-text", x: left + 5, y: bottom - 24 - 17 * index }, label)];
}

export function legend({ series, marks, lines, bands, errors_name }, lines_name) {
    const items = series.map((data, i) => legend_item(
        [...(data.scatter ? [] : [svg("path", { class: `curve ${series_class(i)}`, d: "M0,7H24" })]),
         ...(data.points ? [svg("path", { class: `marker ${series_class(i)}`, d: shape_of(i), transform: "translate(12,7)" })] : [])],
        data.name));
    const banded = series.filter((data) => data.y.some((_, i) => ends_at(data, i) !== null));
    if (banded.length) {
        items.push(legend_item([svg("rect", { class: "error-band neutral", width: 24, height: 14 }),
                                ...(banded.some(({ errors }) => errors) ? [svg("path", { class: "whisker neutral", d: "M12,0V14" })] : [])],
                               errors_name ?? "error of one run"));
    }
    const seen = new Set(series.flatMap(({ looks = [], y }) => looks.filter((look, i) => look && Number.isFinite(y[i])))
        .flatMap((look) => look.split(" ")));
    for (const look of Object.keys(looks).filter((each) => seen.has(each))) {
        items.push(legend_item(marker_parts("neutral", marker_shapes[0], look, look === "bound" ? "translate(12,18)" : "translate(12,7)"),
                               looks[look], look === "bound" ? 24 : 14));
    }
    for (const kind of new Set(marks.map((each) => each.kind))) {
        items.push(legend_item([svg("path", { class: `mark ${kind}`, d: mark_shapes[kind], transform: "translate(12,7)" })], kind));
    }
    for (const kind of new Set(bands.map((each) => each.kind))) {
        items.push(legend_item([svg("rect", { class: `band ${kind}`, width: 24, height: 14 })], kind.replaceAll("-", " ")));
    }
    if (lines_name && lines.some((line) => !line.text)) {
        items.push(legend_item([svg("path", { class: "event", d: "M12,0V14" })], lines_name));
    }
    return items;
}

function legend_item(parts, name, height = 14) {
    return element("li", {}, svg("svg", { viewBox: `0 0 24 ${height}`, width: 24, height, "aria-hidden": "true" }, ...parts), ` ${name}`);
}

// A plot of curves as SVG: axes with units, gaps for missing values, marks on the abscissa, readout by mouse and keyboard. Independent of
// the data's source.
import { element, set_text, svg } from "./dom.js";
import { figure_of, offer_png, offer_svg } from "./figure_files.js";
import { looks } from "./flags.js";
import { number } from "./format.js";
import { band, curve, ends_at, error_at, legend, level, margin, mark, series_class, verticals } from "./plot_parts.js";
import { log_ticks, range_of, tick_label, ticks, widened } from "./plot_scale.js";

const character = 7.6; // digit width at the plot's font size [px]
const longest_name = 20; // characters of a tick's name; the full name is its title

/// The values and the ends of their error bars, where known.
function with_errors(series) {
    const ends = (side) => series.y.map((_, i) => ends_at(series, i)?.[side] ?? null);
    return series.errors || series.low ? [series.y, ends(0), ends(1)] : [series.y];
}

export class Plot {
    /// Subject of this page's figures, for saved files.
    static of = () => "";

    /// host: an empty element. labels: {title, x, y} with units; x_name, x_unit, hint for the readout; lines: meaning of the verticals
    /// without a text. choose(x, key): called when the user picks a point with a click or Enter; key: the point's entry in its series'
    /// `keys`, null for a mark.
    constructor(host, labels, { height = 260, choose = null, y_from_zero = false } = {}) {
        this.labels = labels;
        this.plain_height = height;
        this.choose = choose;
        this.y_from_zero = y_from_zero;
        this.data = { series: [], marks: [], lines: [], levels: [], bands: [] };
        this.at = null; // index into stops
        this.curve_at = 0; // the series of Enter and the arrow keys up and down
        this.picture = svg("svg", { class: "plot", role: "img", tabindex: 0 });
        this.readout = element("p", { class: "readout", "aria-live": "polite" });
        this.legend = element("ul", { class: "legend" });
        const button = (kind, offer) => element("button", { type: "button", class: "link", title: `Save this figure as ${kind}`, onclick: () => {
            if (this.width) offer([this.labels.title, Plot.of()].filter(Boolean).join(" "), figure_of(this, Plot.of()));
        } }, kind);
        host.replaceChildren(this.legend, this.picture, element("div", { class: "under-plot" }, this.readout,
            element("span", { class: "buttons" }, button("SVG", offer_svg), button("PNG", offer_png))));
        new ResizeObserver(() => this.draw()).observe(host);
        this.picture.addEventListener("pointermove", (event) => this.point_at(...this.nearest(event)));
        this.picture.addEventListener("pointerleave", () => this.point_at(null));
        this.picture.addEventListener("blur", () => this.point_at(null));
        this.picture.addEventListener("click", (event) => this.pick(...this.nearest(event)));
        this.picture.addEventListener("keydown", (event) => this.key(event));
    }

    /// data: {series: [{name, unit, x, y, points, scatter, keys, names, looks, notes, errors}], marks: [{x, kind, label}], lines: [{x,
    /// label, text, kind}], levels: [{y, label}], bands: [{from, to, label, kind}], names: [{x, label}] of an abscissa with names at 0, 1,
    /// 2, ..., x_label: its title, x_log: logarithmic}. Of a series: points: markers; scatter: no line; names, looks, notes: of each point
    /// (flags.js); errors: error bars to either side, or low and high: ranges. Marks sit on the abscissa (kind: failed, skipped, running,
    /// pending), lines are verticals, levels horizontals, bands shaded ranges.
    show(data) {
        this.data = { marks: [], lines: [], levels: [], bands: [], ...data };
        const stops = new Set(this.data.marks.map((each) => each.x));
        for (const series of this.data.series) series.x.forEach((x) => Number.isFinite(x) && stops.add(x));
        this.stops = [...stops].sort((a, b) => a - b);
        if (this.at !== null && this.at >= this.stops.length) this.at = null;
        this.draw();
    }

    draw() {
        const width = Math.round(this.picture.getBoundingClientRect().width);
        if (width < 40) return; // hidden: drawn when it gets a size
        const { series, marks, lines, levels, bands } = this.data;
        this.find_ranges();
        this.width = width;
        this.bottom = margin.bottom;
        this.height = this.plain_height;
        this.y_ticks = ticks(...this.y_range, (this.height - margin.top - this.bottom) / 40);
        this.y_labels = this.y_ticks.values.map((y) => tick_label(y, this.y_ticks.step));
        this.left = 36 + character * Math.max(...this.y_labels.map((label) => label.length), 2);
        this.turn_names();
        this.picture.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
        this.picture.setAttribute("height", this.height);
        this.picture.setAttribute("aria-label", this.summary());
        this.cursor = svg("g", { class: "cursor" });
        this.now_line = svg("path", { class: "now" });
        this.picture.replaceChildren(
            ...bands.filter((each) => each.from < this.x_range[1] && each.to > this.x_range[0]).flatMap((each, i) => band(this, each, i)),
            ...this.axes(),
            ...verticals(this, lines.filter((line) => this.inside(line.x))),
            ...levels.flatMap((each, i) => level(this, each, i)),
            ...series.flatMap((each, i) => curve(this, each, i)),
            ...marks.map((each) => mark(this, each)),
            this.now_line, this.cursor);
        this.legend.replaceChildren(...legend(this.data, this.labels.lines));
        this.draw_cursor();
        this.mark_now(this.now);
    }

    /// A vertical at the time of another view; null: none. Outside the axis it stays at its end.
    mark_now(x) {
        this.now = x;
        if (!this.now_line) return;
        if (!Number.isFinite(x)) {
            this.now_line.removeAttribute("d");
            return;
        }
        const at = this.px(Math.min(this.x_range[1], Math.max(this.x_range[0], x))).toFixed(1);
        this.now_line.setAttribute("d", `M${at},${margin.top}V${this.height - this.bottom}`);
    }

    /// Turns the names of ticks that do not fit side by side, and makes room for them.
    turn_names() {
        const { names } = this.data;
        this.turned = 0;
        if (!names) return;
        const longest = Math.min(longest_name, Math.max(...names.map(({ label }) => label.length)));
        const space = (this.width - this.left - margin.right) / names.length;
        if (longest * character + 6 <= space) return;
        this.turned = space < 40 ? 90 : 50;
        const more = longest * character * Math.sin((this.turned * Math.PI) / 180);
        this.bottom += more;
        this.height += more;
    }

    find_ranges() {
        const { series, marks, levels, names } = this.data;
        const [left, right] = range_of(series.map((each) => each.x), marks.map((each) => each.x));
        const [low, high] = widened(range_of(series.flatMap(with_errors), this.y_from_zero ? [0] : []),
                                    levels.map((each) => each.y));
        const pad_x = (right - left) * (marks.length || series.some((each) => each.points) ? 0.04 : 0);
        const pad_y = (high - low) * 0.06;
        const factor = (right / left) ** 0.04;
        this.x_range = names ? [-0.5, names.length - 0.5] : this.data.x_log ? [left / factor, right * factor] : [left - pad_x, right + pad_x];
        this.y_range = [low === 0 ? 0 : low - pad_y, high + pad_y];
    }

    // ---- parts of the picture

    inside(x) {
        return x >= this.x_range[0] && x <= this.x_range[1];
    }

    px(x) {
        const [low, high] = this.x_range;
        const share = this.data.x_log ? Math.log(x / low) / Math.log(high / low) : (x - low) / (high - low);
        return this.left + share * (this.width - this.left - margin.right);
    }

    py(y) {
        const [low, high] = this.y_range;
        return this.height - this.bottom - ((y - low) / (high - low)) * (this.height - margin.top - this.bottom);
    }

    axes() {
        const bottom = this.height - this.bottom;
        const right = this.width - margin.right;
        const parts = [];
        for (const { x, label, title } of this.x_ticks()) {
            const at = this.px(x);
            const place = this.turned ? { transform: `translate(${at + 4},${bottom + 12}) rotate(${-this.turned})`, "text-anchor": "end" }
                                      : { x: at, y: bottom + 17, "text-anchor": "middle" };
            parts.push(svg("path", { class: "grid", d: `M${at},${margin.top}V${bottom}` }),
                       svg("text", { ...place, class: "tick-x" }, label, ...(title ? [svg("title", {}, title)] : [])));
        }
        this.y_ticks.values.forEach((y, i) => {
            const at = this.py(y);
            parts.push(svg("path", { class: "grid", d: `M${this.left},${at}H${right}` }),
                       svg("text", { x: this.left - 7, y: at + 4, "text-anchor": "end" }, this.y_labels[i]));
        });
        const middle = (margin.top + bottom) / 2;
        parts.push(svg("path", { class: "axis", d: `M${this.left},${margin.top}V${bottom}H${right}` }),
                   svg("text", { class: "label", x: (this.left + right) / 2, y: this.height - 8,
                                 "text-anchor": "middle" }, this.data.x_label ?? this.labels.x),
                   svg("text", { class: "label", x: 14, y: middle, "text-anchor": "middle",
                                 transform: `rotate(-90 14 ${middle})` }, this.labels.y));
        return parts;
    }

    x_ticks() {
        const { names } = this.data;
        if (names) {
            return names.map(({ x, label }) => (label.length <= longest_name ? { x, label }
                : { x, label: `${label.slice(0, longest_name - 1)}…`, title: label }));
        }
        if (this.data.x_log) return log_ticks(...this.x_range).map((x) => ({ x, label: number(x) }));
        const { values, step } = ticks(...this.x_range, (this.width - margin.right - this.left) / 80);
        return values.map((x) => ({ x, label: tick_label(x, step) }));
    }

    summary() {
        const filled = this.data.series.reduce((most, s) => Math.max(most, s.y.filter(Number.isFinite).length), 0);
        const levels = this.data.levels.map(({ label, y }) => ` ${label} ${number(y)}.`).join("");
        return `${this.labels.title}: ${this.labels.y} against ${this.data.x_label ?? this.labels.x}, ${filled} values.${levels} ` +
               "Left and right arrow keys read them out.";
    }

    // ---- readout

    /// [index of the stop, of the series, of the point in it] nearest to the pointer; for markers in both directions. Without the last
    /// index: the first point there.
    nearest(event) {
        if (!this.stops || this.stops.length === 0 || !this.x_range) return [null, 0];
        const box = this.picture.getBoundingClientRect();
        const [x, y] = [event.clientX - box.left, event.clientY - box.top];
        let best = { stop: 0, distance: Infinity, series: this.curve_at };
        this.stops.forEach((stop, i) => {
            const distance = Math.abs(this.px(stop) - x);
            if (distance < best.distance) best = { stop: i, distance, series: this.curve_at };
        });
        const reach = best.distance + 6; // markers above each other: the one below the pointer
        let nearest = Infinity;
        this.data.series.forEach((series, k) => series.points && series.x.forEach((at, i) => {
            const dx = Math.abs(this.px(at) - x);
            if (!Number.isFinite(series.y[i]) || dx > (series.scatter ? 12 : reach)) return;
            const distance = Math.hypot(dx, this.py(series.y[i]) - y);
            if (distance >= nearest) return;
            nearest = distance;
            best = { stop: this.stops.indexOf(at), distance, series: k, i };
        }));
        return [best.stop, best.series, best.i];
    }

    point_at(index, series = this.curve_at, i = null) {
        if (index === this.at && series === this.curve_at && i === this.i_at) return;
        this.at = index;
        this.curve_at = series;
        this.i_at = i;
        this.draw_cursor();
    }

    pick(index, series = this.curve_at, i = null) {
        if (index === null || !this.choose) return;
        const x = this.stops[index];
        const there = this.at_stop(x, series, i);
        const meant = there.find((each) => each.index === series) ?? there[0];
        this.choose(x, meant?.series.keys?.[meant.i] ?? null);
    }

    /// The series that have a value at x. meant, at: series and index of the chosen point. A step has two points at its x: the second
    /// counts.
    at_stop(x, meant = null, at = null) {
        return this.data.series.map((series, index) => ({ series, index, i: index === meant && at !== null ? at : series.scatter ? series.x.indexOf(x) : series.x.lastIndexOf(x) }))
            .filter(({ series, i }) => i >= 0 && Number.isFinite(series.y[i]));
    }

    key(event) {
        const last = (this.stops?.length ?? 0) - 1;
        if (last < 0) return;
        const moves = { ArrowLeft: Math.max((this.at ?? 1) - 1, 0), ArrowRight: Math.min((this.at ?? -1) + 1, last),
                        Home: 0, End: last };
        const count = this.data.series.length;
        if (event.key in moves) this.point_at(moves[event.key]);
        else if (event.key === "Enter") this.pick(this.at);
        else if (count > 1 && event.key === "ArrowDown") this.point_at(this.at ?? 0, (this.curve_at + 1) % count);
        else if (count > 1 && event.key === "ArrowUp") this.point_at(this.at ?? 0, (this.curve_at + count - 1) % count);
        else return;
        event.preventDefault();
    }

    draw_cursor() {
        if (!this.cursor) return;
        this.cursor.replaceChildren();
        if (this.at === null || this.at === undefined) {
            set_text(this.readout, this.labels.hint ?? "");
            return;
        }
        const x = this.stops[this.at];
        this.cursor.append(svg("path", { d: `M${this.px(x)},${margin.top}V${this.height - this.bottom}` }));
        const values = this.at_stop(x, this.curve_at, this.i_at ?? null).map(({ series, index, i }) => {
            const meant = index === this.curve_at && this.data.series.length > 1 && this.choose;
            this.cursor.append(svg("circle", { class: series_class(index), cx: this.px(x), cy: this.py(series.y[i]), r: meant ? 6.5 : 4.5 }));
            const name = [series.name, series.names?.[i]].filter(Boolean).join(", ");
            const meaning = (series.looks?.[i] ?? "").split(" ").filter(Boolean).map((look) => looks[look]).join(", ");
            const error = error_at(series, i);
            const ends = error === null ? ends_at(series, i) : null;
            const value = number(series.y[i]) + (error === null ? "" : ` ± ${number(error, 2)}`) + (ends ? ` (${number(ends[0], 3)} to ${number(ends[1], 3)})` : "");
            return `${name} ${value} ${series.unit ?? ""}`.trim() + (meaning && ` (${meaning})`);
        });
        for (const each of this.data.marks) if (each.x === x) values.push(each.label);
        const named = this.data.names?.find((each) => each.x === Math.round(x))?.label;
        set_text(this.readout, `${named ?? `${this.labels.x_name} = ${number(x)} ${this.labels.x_unit}`.trim()}: ${values.join(" · ")}`);
    }
}

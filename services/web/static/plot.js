// A plot of curves against one abscissa, as SVG: axes with units, gaps where values are missing, marks on the
// abscissa, hover and keyboard readout. Knows nothing of where the numbers come from.
import { element, set_text, svg } from "./dom.js";
import { number } from "./format.js";

const margin = { right: 14, top: 12, bottom: 46 };
const character = 7.6; // width of a digit at the plot's font size [px]

/// About `wanted` round values that cover [low, high].
export function ticks(low, high, wanted) {
    const raw = (high - low) / Math.max(wanted, 1);
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 2.5, 5, 10].find((factor) => factor * power >= raw * 0.999);
    const values = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1) values.push(i * step);
    return { values, step };
}

function tick_label(value, step) {
    if (Math.abs(value) < 1e-9 * step) return "0";
    if (Math.abs(value) >= 1e5 || step < 1e-4) return number(value, 3);
    const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
    const fits = Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) < 1e-6;
    return value.toFixed(fits ? decimals : decimals + 1);
}

/// Range of the finite values, a little wider; `least` values are always inside.
function range_of(lists, least) {
    let low = Infinity;
    let high = -Infinity;
    const widen = (value) => {
        if (value === null || !Number.isFinite(value)) return;
        low = Math.min(low, value);
        high = Math.max(high, value);
    };
    for (const list of lists) list.forEach(widen);
    least.forEach(widen);
    if (low > high) return [0, 1];
    if (low === high) return [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
    return [low, high];
}

/// Points per pixel column that a long curve is thinned to: the lowest and highest stay, so no peak is lost.
function thinned(xs, ys, columns) {
    if (xs.length <= 4 * columns) return xs.map((_, i) => i);
    const kept = [];
    const per_column = xs.length / columns;
    for (let column = 0; column < columns; column += 1) {
        const first = Math.floor(column * per_column);
        const end = Math.min(xs.length, Math.floor((column + 1) * per_column));
        let lowest = first;
        let highest = first;
        for (let i = first; i < end; i += 1) {
            if (ys[i] < ys[lowest]) lowest = i;
            if (ys[i] > ys[highest]) highest = i;
        }
        kept.push(...[...new Set([first, lowest, highest, end - 1])].sort((a, b) => a - b));
    }
    return kept;
}

const marker_shapes = ["M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0", "M-4,-4h8v8h-8z", "M0,-5.5L5,3.5H-5z"];
const mark_shapes = {
    failed: "M-5,-5L5,5M-5,5L5,-5",
    skipped: "M-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0M-3.5,3.5L3.5,-3.5",
    pending: "M0,-4V4",
    running: "M-3,-5L5,0L-3,5z",
};

export class Plot {
    /// host: an empty element. labels: {title, x, y} with units; x_name, x_unit for the readout. choose(x) is called
    /// when a person picks an abscissa with a click or Enter.
    constructor(host, labels, { height = 260, choose = null, y_from_zero = false } = {}) {
        this.labels = labels;
        this.height = height;
        this.choose = choose;
        this.y_from_zero = y_from_zero;
        this.data = { series: [], marks: [], lines: [] };
        this.at = null; // index into stops_
        this.picture = svg("svg", { class: "plot", role: "img", tabindex: 0 });
        this.readout = element("p", { class: "readout", "aria-live": "polite" });
        this.legend = element("ul", { class: "legend" });
        host.replaceChildren(this.legend, this.picture, this.readout);
        new ResizeObserver(() => this.draw()).observe(host);
        this.picture.addEventListener("pointermove", (event) => this.point_at(this.nearest(event)));
        this.picture.addEventListener("pointerleave", () => this.point_at(null));
        this.picture.addEventListener("blur", () => this.point_at(null));
        this.picture.addEventListener("click", (event) => this.pick(this.nearest(event)));
        this.picture.addEventListener("keydown", (event) => this.key(event));
    }

    /// data: {series: [{name, x, y, points}], marks: [{x, kind, label}], lines: [{x, label}]}; marks sit on the
    /// abscissa (kind: failed, skipped, running, pending), lines are thin verticals.
    show(data) {
        this.data = { marks: [], lines: [], ...data };
        const stops = new Set(this.data.marks.map((mark) => mark.x));
        for (const series of this.data.series) series.x.forEach((x) => stops.add(x));
        this.stops = [...stops].sort((a, b) => a - b);
        if (this.at !== null && this.at >= this.stops.length) this.at = null;
        this.draw();
    }

    draw() {
        const width = Math.round(this.picture.getBoundingClientRect().width);
        if (width < 40) return; // hidden: drawn when it gets a size
        const { series, marks, lines } = this.data;
        this.x_range = range_of(series.map((curve) => curve.x), marks.map((mark) => mark.x));
        this.y_range = range_of(series.map((curve) => curve.y), this.y_from_zero ? [0] : []);
        const pad_x = (this.x_range[1] - this.x_range[0]) * (marks.length || series.some((c) => c.points) ? 0.04 : 0);
        const pad_y = (this.y_range[1] - this.y_range[0]) * 0.06;
        this.x_range = [this.x_range[0] - pad_x, this.x_range[1] + pad_x];
        this.y_range = [this.y_range[0] === 0 ? 0 : this.y_range[0] - pad_y, this.y_range[1] + pad_y];
        this.width = width;
        this.y_ticks = ticks(...this.y_range, (this.height - margin.top - margin.bottom) / 40);
        this.y_labels = this.y_ticks.values.map((y) => tick_label(y, this.y_ticks.step));
        this.left = 36 + character * Math.max(...this.y_labels.map((label) => label.length), 2);
        this.picture.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
        this.picture.setAttribute("height", this.height);
        this.picture.setAttribute("aria-label", this.summary());
        this.cursor = svg("g", { class: "cursor" });
        this.picture.replaceChildren(
            ...this.axes(),
            ...lines.filter((line) => this.inside(line.x)).map((line) => this.vertical(line)),
            ...series.flatMap((curve, i) => this.curve(curve, i)),
            ...marks.map((mark) => this.mark(mark)),
            this.cursor);
        this.draw_legend();
        this.draw_cursor();
    }

    // ---- parts of the picture

    inside(x) {
        return x >= this.x_range[0] && x <= this.x_range[1];
    }

    px(x) {
        const [low, high] = this.x_range;
        return this.left + ((x - low) / (high - low)) * (this.width - this.left - margin.right);
    }

    py(y) {
        const [low, high] = this.y_range;
        return this.height - margin.bottom - ((y - low) / (high - low)) * (this.height - margin.top - margin.bottom);
    }

    axes() {
        const bottom = this.height - margin.bottom;
        const right = this.width - margin.right;
        const parts = [];
        const x_ticks = ticks(...this.x_range, (right - this.left) / 80);
        for (const x of x_ticks.values) {
            const at = this.px(x);
            parts.push(svg("path", { class: "grid", d: `M${at},${margin.top}V${bottom}` }),
                       svg("text", { x: at, y: bottom + 17, "text-anchor": "middle" }, tick_label(x, x_ticks.step)));
        }
        this.y_ticks.values.forEach((y, i) => {
            const at = this.py(y);
            parts.push(svg("path", { class: "grid", d: `M${this.left},${at}H${right}` }),
                       svg("text", { x: this.left - 7, y: at + 4, "text-anchor": "end" }, this.y_labels[i]));
        });
        const middle = (margin.top + bottom) / 2;
        parts.push(svg("path", { class: "axis", d: `M${this.left},${margin.top}V${bottom}H${right}` }),
                   svg("text", { class: "label", x: (this.left + right) / 2, y: this.height - 8,
                                 "text-anchor": "middle" }, this.labels.x),
                   svg("text", { class: "label", x: 14, y: middle, "text-anchor": "middle",
                                 transform: `rotate(-90 14 ${middle})` }, this.labels.y));
        return parts;
    }

    curve(curve, index) {
        const kept = curve.points ? curve.x.map((_, i) => i) : thinned(curve.x, curve.y, this.width);
        let path = "";
        let drawing = false;
        for (const i of kept) {
            const y = curve.y[i];
            if (y === null || !Number.isFinite(y)) {
                drawing = false;
                continue;
            }
            path += `${drawing ? "L" : "M"}${this.px(curve.x[i]).toFixed(1)},${this.py(y).toFixed(1)}`;
            drawing = true;
        }
        const parts = [svg("path", { class: `curve series-${index}`, d: path })];
        if (!curve.points) return parts;
        for (const i of kept) {
            if (curve.y[i] === null || !Number.isFinite(curve.y[i])) continue;
            parts.push(svg("path", { class: `marker series-${index}`, d: marker_shapes[index % marker_shapes.length],
                                     transform: `translate(${this.px(curve.x[i])},${this.py(curve.y[i])})` }));
        }
        return parts;
    }

    mark(mark) {
        const at = this.height - margin.bottom - 9;
        return svg("path", { class: `mark ${mark.kind}`, d: mark_shapes[mark.kind],
                             transform: `translate(${this.px(mark.x)},${at})` },
                   svg("title", {}, mark.label));
    }

    vertical(line) {
        return svg("path", { class: "event", d: `M${this.px(line.x)},${margin.top}V${this.height - margin.bottom}` },
                   svg("title", {}, line.label));
    }

    draw_legend() {
        const { series, marks, lines } = this.data;
        const items = series.map((curve, i) => this.legend_item(
            [svg("path", { class: `curve series-${i}`, d: "M0,7H24" }),
             ...(curve.points ? [svg("path", { class: `marker series-${i}`, d: marker_shapes[i % 3],
                                               transform: "translate(12,7)" })] : [])], curve.name));
        for (const kind of new Set(marks.map((mark) => mark.kind))) {
            items.push(this.legend_item(
                [svg("path", { class: `mark ${kind}`, d: mark_shapes[kind], transform: "translate(12,7)" })], kind));
        }
        if (lines.length > 0 && this.labels.lines) {
            items.push(this.legend_item([svg("path", { class: "event", d: "M12,0V14" })], this.labels.lines));
        }
        this.legend.replaceChildren(...items);
    }

    legend_item(parts, name) {
        return element("li", {}, svg("svg", { viewBox: "0 0 24 14", width: 24, height: 14, "aria-hidden": "true" },
                                     ...parts), ` ${name}`);
    }

    summary() {
        const filled = this.data.series.reduce((most, s) => Math.max(most, s.y.filter(Number.isFinite).length), 0);
        return `${this.labels.title}: ${this.labels.y} against ${this.labels.x}, ${filled} values. ` +
               "Left and right arrow keys read them out.";
    }

    // ---- readout

    nearest(event) {
        if (!this.stops || this.stops.length === 0 || !this.x_range) return null;
        const x = event.clientX - this.picture.getBoundingClientRect().left;
        let best = 0;
        for (let i = 1; i < this.stops.length; i += 1) {
            if (Math.abs(this.px(this.stops[i]) - x) < Math.abs(this.px(this.stops[best]) - x)) best = i;
        }
        return best;
    }

    point_at(index) {
        if (index === this.at) return;
        this.at = index;
        this.draw_cursor();
    }

    pick(index) {
        if (index !== null && this.choose) this.choose(this.stops[index]);
    }

    key(event) {
        const last = (this.stops?.length ?? 0) - 1;
        if (last < 0) return;
        const moves = { ArrowLeft: Math.max((this.at ?? 1) - 1, 0), ArrowRight: Math.min((this.at ?? -1) + 1, last),
                        Home: 0, End: last };
        if (event.key in moves) this.point_at(moves[event.key]);
        else if (event.key === "Enter") this.pick(this.at);
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
        const values = [];
        this.cursor.append(svg("path", { d: `M${this.px(x)},${margin.top}V${this.height - margin.bottom}` }));
        this.data.series.forEach((curve, index) => {
            const y = curve.y[curve.x.indexOf(x)];
            if (!Number.isFinite(y)) return;
            values.push(`${curve.name} ${number(y)} ${curve.unit ?? ""}`.trim());
            this.cursor.append(svg("circle", { class: `series-${index}`, cx: this.px(x), cy: this.py(y), r: 4.5 }));
        });
        const mark = this.data.marks.find((candidate) => candidate.x === x);
        if (mark) values.push(mark.label);
        set_text(this.readout, `${this.labels.x_name} = ${number(x)} ${this.labels.x_unit}: ${values.join(" · ")}`);
    }
}

// The section before and after the runout in one picture, with the slip surface, the water, the toe, the runout and its band, the gauges.
import { element, svg } from "./dom.js";
import { apart } from "./overlay.js";
import { level_at } from "./scene.js";
import { tick_label, ticks } from "./plot_scale.js";

const flat = 140;          // [px] lower sections are drawn with exaggerated heights
const most_stretched = 5;
const chords = 60;
const character = 7.6;     // [px] of a character
const margin = { side: 14, top: 34, bottom: 24 };

/// The slip surface of a stability analysis as points; []: none.
export function slip_surface(result, floor) {
    if (result?.points) return result.points;
    if (!result?.circle) return [];
    const { center: [x_c, y_c], radius } = result.circle;
    const angle = ([x]) => -Math.acos(Math.min(1, Math.max(-1, (x - x_c) / radius)));
    const [from, to] = [angle(result.entry), angle(result.exit)];
    const line = result.follows_floor ? result.floor ?? floor ?? [] : [];
    return Array.from({ length: chords + 1 }, (_, i) => {
        const at = from + ((to - from) * i) / chords;
        const x = x_c + radius * Math.cos(at);
        const y = y_c + radius * Math.sin(at);
        return [x, line.length ? Math.max(y, level_at(line, x)) : y];
    });
}

/// [{x, ground, surface}] of profile.csv [m].
export function profile_in(table) {
    const [head, ...lines] = table.trim().split("\n").map((line) => line.split(","));
    const value = (line, name) => Number(line[head.indexOf(`${name}_m`)]);
    return lines.map((line) => ({ x: value(line, "x"), ground: value(line, "ground"), surface: value(line, "surface") }));
}

const half_of = (text) => (text.length * character) / 2 + 3;
const wedge = (x, y) => `M${x},${y}l-5,-9h10Z`;
const span_of = (values) => [Math.min(...values), Math.max(...values)];

export class SectionPicture {
    constructor(host) {
        this.picture = svg("svg", { class: "plot section", role: "img" });
        this.legend = element("ul", { class: "legend" });
        host.replaceChildren(this.picture, this.legend);
        new ResizeObserver(() => this.draw()).observe(host);
    }

    /// parts: {outlines, after: the soil's surface and back along the ground, after_name, slip, slip_name, water: [[x, y]], toe, gauges:
    /// [{name, x, y}], runout: {reach, low, high, text}, says}. null or empty parts are not drawn.
    show(parts) {
        this.parts = parts;
        this.draw();
    }

    draw() {
        const width = Math.round(this.picture.getBoundingClientRect().width);
        const { parts } = this;
        const soil = [...(parts?.outlines ?? []), parts?.after ?? []].flat();
        if (width < 40 || soil.length === 0) return;
        const { toe, runout, gauges } = parts;
        const places = [...soil.map(([x]) => x), ...gauges.map(({ x }) => x), ...(toe && runout ? [runout.reach, runout.high].map((reach) => toe[0] + reach) : [])];
        const [x_low, x_high] = span_of(places.filter(Number.isFinite));
        const [y_low, y_high] = span_of(soil.map(([, y]) => y));
        const scale = (width - 2 * margin.side) / (x_high - x_low);
        this.stretch = Math.min(most_stretched, Math.max(1, Math.floor(flat / (scale * (y_high - y_low)))));
        const px = (x) => margin.side + (x - x_low) * scale;
        const named = gauges.map(({ name, x, y }) => ({ name, y, x: px(x), half: half_of(name) })).sort((a, b) => a.x - b.x);
        const names = apart(named, width);
        const ground = Math.max(...gauges.map(({ y }) => y)); // all names stand above it
        const top = Math.max(margin.top, 26 + 13 * (1 + Math.max(...names.map(({ line }) => line))) - (y_high - ground) * scale * this.stretch);
        const py = (y) => top + (y_high - y) * scale * this.stretch;
        const bottom = py(y_low);
        const path = (points) => `M${points.map(([x, y]) => `${px(x).toFixed(1)},${py(y).toFixed(1)}`).join("L")}`;
        const inside = (at, text) => apart([{ x: at, half: half_of(text) }], width)[0].at;
        const drawn = [];
        const add = (tag, attributes, ...text) => drawn.push(svg(tag, attributes, ...text));
        for (const outline of parts.outlines.filter(({ length }) => length)) add("path", { class: "before", d: `${path(outline)}Z` });
        if (parts.after?.length) add("path", { class: "after", d: `${path(parts.after)}Z` });
        if (parts.water) add("path", { class: "water", d: path(parts.water) });
        if (parts.slip.length) add("path", { class: "slip", d: path(parts.slip) });
        for (const { x, y } of named) add("path", { class: "gauge", d: wedge(x, py(y)) });
        names.forEach(({ at, line }, i) => add("text", { x: at, y: py(ground) - 10 - 13 * line, "text-anchor": "middle" }, named[i].name));
        if (toe) add("path", { class: "toe", d: wedge(px(toe[0]), py(toe[1])) });
        if (toe && runout) {
            const [from, to, level] = [px(toe[0]), px(toe[0] + runout.reach), 22];
            if (Number.isFinite(runout.low)) {
                const [low, high] = [runout.low, runout.high].map((reach) => px(toe[0] + reach));
                add("rect", { class: "band", x: low, y: level - 6, width: Math.max(high - low, 1), height: 12 });
            }
            add("path", { class: "runout", d: `M${from},${level - 6}v12M${from},${level}H${to}M${to},${level - 6}v12M${to},${level}V${bottom}` });
            add("text", { class: "label", x: inside((from + to) / 2, runout.text), y: 13, "text-anchor": "middle" }, runout.text);
        }
        const { values, step } = ticks(x_low, x_high, width / 110);
        add("path", { class: "axis", d: `M${margin.side},${bottom}H${width - margin.side}${values.map((x) => `M${px(x)},${bottom}v4`).join("")}` });
        for (const x of values) {
            const label = `${tick_label(x, step)}${x === values.at(-1) ? " m" : ""}`;
            add("text", { x: inside(px(x), label), y: bottom + 17, "text-anchor": "middle" }, label);
        }
        this.picture.setAttribute("viewBox", `0 0 ${width} ${bottom + margin.bottom}`);
        this.picture.setAttribute("height", bottom + margin.bottom);
        this.picture.setAttribute("aria-label", parts.says);
        this.picture.replaceChildren(...drawn);
        this.legend.replaceChildren(...this.entries().map(([kind, text]) => element("li", {}, swatch_of(kind), text)));
    }

    entries() {
        const { outlines, after, after_name, water, slip, slip_name, toe, runout, gauges } = this.parts;
        return [["before", "before", outlines.flat().length], ["after", after_name, after?.length], ["slip", slip_name, slip.length], ["water", "water before", water],
                ["toe", "toe", toe], ["runout", "runout", toe && runout], ["band", runout?.band ?? "", Number.isFinite(runout?.low)], ["gauge", "gauge", gauges.length],
                ["", `heights × ${this.stretch}`, this.stretch > 1]].filter(([, , there]) => there);
    }
}

const areas = ["before", "after", "band"];
const wedges = ["toe", "gauge"];

function swatch_of(kind) {
    const d = areas.includes(kind) ? "M0,2H22V13H0Z" : wedges.includes(kind) ? wedge(11, 12) : "M0,7H22";
    return kind ? svg("svg", { class: "section", width: 22, height: 14, "aria-hidden": "true" }, svg("path", { class: kind, d })) : "";
}

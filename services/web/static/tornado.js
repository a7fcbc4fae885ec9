// Bars to both sides of a centre, the longest on top: the effect of each parameter alone.
import { element, svg } from "./dom.js";
import { figure_of, offer_png, offer_svg } from "./figure_files.js";
import { number } from "./format.js";
import { Plot } from "./plot.js";
import { range_of, tick_label, ticks } from "./plot_scale.js";

const row_height = 30;
const [top, bottom, right] = [8, 46, 52];
const sides = [{ key: "p10", name: "parameter at its p10", look: "series-0" }, { key: "p90", name: "parameter at its p90", look: "series-1" }];

export class Tornado {
    constructor(host) {
        this.labels = { title: "One parameter at a time" };
        this.picture = svg("svg", { class: "plot tornado", role: "img" });
        this.legend = element("ul", { class: "legend" }, ...sides.map(({ name, look }) => element("li", {},
            svg("svg", { viewBox: "0 0 24 14", width: 24, height: 14, "aria-hidden": "true" }, svg("rect", { class: `bar ${look}`, x: 2, y: 2, width: 20, height: 10 })), ` ${name}`)));
        const button = (kind, offer) => element("button", { type: "button", class: "link", title: `Save this figure as ${kind}`, onclick: () => {
            if (this.width) offer([this.labels.title, Plot.of()].filter(Boolean).join(" "), figure_of(this, Plot.of()));
        } }, kind);
        host.replaceChildren(this.legend, this.picture, element("div", { class: "under-plot" }, element("span"),
            element("span", { class: "buttons" }, button("SVG", offer_svg), button("PNG", offer_png))));
        new ResizeObserver(() => this.draw()).observe(host);
    }

    /// data: {at_median, bars: [{parameter, p10, p90}]}; label: of the values, with their unit.
    show(data, label) {
        this.data = data;
        this.label = label;
        this.draw();
    }

    draw() {
        const width = Math.round(this.picture.getBoundingClientRect().width);
        if (!this.data || width < 40) return;
        const { at_median: middle } = this.data;
        const reach = ({ p10, p90 }) => Math.max(p10, p90, middle) - Math.min(p10, p90, middle);
        const bars = [...this.data.bars].sort((a, b) => reach(b) - reach(a));
        const longest = Math.max(...bars.map(({ parameter }) => parameter.length));
        const left = Math.min(0.4 * width, 24 + 7 * longest) + 44;
        const [low, high] = range_of([bars.flatMap(({ p10, p90 }) => [p10, p90])], [middle]);
        const px = (value) => left + ((value - low) / (high - low)) * (width - left - right);
        const height = top + row_height * bars.length + bottom;
        const base = height - bottom;
        const { values, step } = ticks(low, high, (width - left - right) / 50);
        this.width = width;
        this.height = height;
        this.picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
        this.picture.setAttribute("height", height);
        this.picture.setAttribute("aria-label", `${this.label}, ${number(middle)} at the medians. ` + bars.map(({ parameter, p10, p90 }) =>
            `${parameter}: ${number(p10)} at its p10, ${number(p90)} at its p90.`).join(" "));
        this.picture.replaceChildren(
            ...values.flatMap((x) => [svg("path", { class: "grid", d: `M${px(x)},${top}V${base}` }),
                                      svg("text", { x: px(x), y: base + 17, "text-anchor": "middle" }, tick_label(x, step))]),
            ...bars.flatMap((bar, i) => this.bar(bar, top + row_height * i, px, middle, left)),
            svg("path", { class: "axis", d: `M${px(middle)},${top}V${base}M${left},${base}H${width - right}` }),
            svg("text", { class: "label", x: (left + width - right) / 2, y: height - 8, "text-anchor": "middle" }, this.label));
    }

    /// Both halves with their values, the longer one below if they are on the same side.
    bar(bar, y, px, middle, left) {
        const halves = sides.map(({ key, look }) => ({ value: bar[key], look })).sort((a, b) => Math.abs(b.value - middle) - Math.abs(a.value - middle));
        const same = Math.sign(bar.p10 - middle) === Math.sign(bar.p90 - middle);
        const parts = halves.filter(({ value }) => value !== middle).map(({ value, look }) => svg("rect", { class: `bar ${look}`, x: Math.min(px(value), px(middle)), y: y + 5,
                                                                    width: Math.max(1, Math.abs(px(value) - px(middle))), height: row_height - 10 }));
        const texts = (same ? halves.slice(0, 1) : halves).filter(({ value }) => value !== middle).map(({ value }) => svg("text", { x: px(value) + (value < middle ? -5 : 5), y: y + row_height / 2 + 4,
            "text-anchor": value < middle ? "end" : "start" }, number(value, 3)));
        return [...parts, ...texts, svg("text", { class: "label", x: left - 56, y: y + row_height / 2 + 4, "text-anchor": "end" }, bar.parameter,
                                        svg("title", {}, `${bar.parameter}: ${number(bar.p10)} at its p10, ${number(bar.p90)} at its p90`))];
    }
}

// The scale of a field: its range, the range's origin, and the legend, in the page's PREFIX-scale (numbers) and PREFIX-regions (names).
import { band_gradient, region_css, scale_gradient } from "./colours.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { extremes_of, field_label, is_named, note_of, reach_of, unit_of } from "./fields.js";
import { number } from "./format.js";

export class Scale {
    /// changed(): called when the user changes the range.
    constructor(prefix, changed) {
        this.prefix = prefix;
        const id = (name) => `${prefix}-${name}`;
        const end = (name, label) => element("input", { type: "number", id: id(name), step: "any", value: 0, "aria-label": label, onchange: changed });
        const option = (value, text) => element("option", { value }, text);
        this.part("scale").append(
            element("p", { id: id("range"), class: "scale-name" }),
            end("low", "low end of the scale"), element("span", { id: id("ramp"), class: "ramp", "aria-hidden": "true" }), end("high", "high end of the scale"),
            element("label", {}, "range ", element("select", { id: id("scale-of"), onchange: changed }, option("all", "fixed over time"),
                                                   option("this", "of each snapshot"), option("hand", "by hand"))),
            element("span", { id: id("none") }, element("span", { class: "chip none" }), " no value there"),
            element("p", { id: id("scale-note"), class: "muted hint" }));
    }

    part(name) {
        return by_id(`${this.prefix}-${name}`);
    }

    // shown: the last drawn: {colour, names, grey: some have no value, notes: [origin of the range, meaning of the values]}

    /// The colours of a field for snapshots shown together; sources: their Snapshots. Draws the legend.
    of(field, snapshots, sources, { contours = false } = {}) {
        const named = is_named(field);
        this.part("scale").hidden = named;
        this.part("regions").hidden = !named;
        if (named) {
            const names = field === "region" ? snapshots[0].regions : snapshots[0].materials;
            this.draw_names(names);
            this.shown = { colour: { field, named }, names, grey: false, notes: [] };
        } else {
            const range = this.range(field, snapshots, sources);
            const notes = this.draw(field, range, snapshots, contours);
            this.shown = { colour: { field, ...range, contours }, grey: !this.part("none").hidden, notes };
        }
        return this.shown.colour;
    }

    range(field, snapshots, sources) {
        const [low_input, high_input] = [this.part("low"), this.part("high")];
        const of = this.part("scale-of").value;
        low_input.disabled = high_input.disabled = of !== "hand";
        if (of !== "hand") {
            const reaches = of === "all" ? sources.map((source) => source.reach(field))
                : snapshots.map(({ columns }) => reach_of(columns[field] ?? []));
            const low = Math.min(...reaches.map((reach) => reach[0]));
            const high = Math.max(...reaches.map((reach) => reach[1]));
            low_input.value = number(low, 2);
            high_input.value = number(high > low ? high : low + 1, 2);
        }
        const [low, high] = [Number(low_input.value), Number(high_input.value)];
        const texts = { all: `fixed over time, from 98 % of the values of ${[...new Set(sources.map((source) => source.reach_text()))].join(" and ")}`,
                        this: "from 98 % of the values of this snapshot: in another one the colours mean other values", hand: "set by hand" };
        return { low, high: high > low ? high : low + 1, text: texts[of] };
    }

    draw(field, { low, high, text }, snapshots, contours) {
        const is_mesh = snapshots.some(({ quads }) => quads);
        this.part("ramp").style.background = contours ? band_gradient : scale_gradient;
        set_text(this.part("range"), `${field_label(field)}, ${number(low)} to ${number(high)}`);
        const ends = snapshots.map(({ columns }) => extremes_of(columns[field] ?? []));
        const spans = ends.map((end) => (end ? `${number(end[0], 3)} to ${number(end[1], 3)} ${unit_of(field)}`.replace(/ –$/, "") : "no value"));
        const [range, values] = [`Range ${text}.`, note_of(field, is_mesh) && `Values: ${note_of(field, is_mesh)}.`];
        set_text(this.part("scale-note"), [range, `Shown now: ${spans.join(" | ")}; beyond the ends, the colour of the end.`, values].filter(Boolean).join(" "));
        this.part("none").hidden = !snapshots.some(({ columns }) => columns[field]?.some(Number.isNaN));
        return [range, values];
    }

    draw_names(names) {
        // A region and a material may have the same name with different colours: the index is the key.
        mirror(this.part("regions"), names.map((name, i) => ({ name, i })), ({ name, i }) => `${i}/${name}`,
               ({ name, i }) => element("li", {}, element("span", { class: "chip", style: `background: ${region_css(i)}` }), ` ${name}`),
               () => {});
    }
}

// The soils of a scene as a table: density, strength and stiffness with units and plausible ranges, and presets with their source.
import { read_example } from "./api.js";
import { element, mirror, set_text } from "./dom.js";
import { Scalar } from "./form_fields.js";
import { NamedRows } from "./form_rows.js";
import { pointer_of } from "./json_text.js";
import { branch_of, plausible_of, unit_of } from "./schema.js";

const columns = [
    { way: ["density"], title: "density" },
    { way: ["limit_strength", "c_kPa"], title: "c'", of: "stability" }, { way: ["limit_strength", "phi_deg"], title: "φ'", of: "stability" },
    { way: ["law", "c_kPa"], title: "c", of: "deformation and runout" }, { way: ["law", "phi_deg"], title: "φ", of: "deformation and runout" },
    { way: ["law", "E_MPa"], title: "E", of: "deformation and runout" }, { way: ["law", "nu"], title: "ν", of: "deformation and runout" },
];

/// The schema's entry at a soil's place; undefined: the soil's law has none.
function entry_of(entry, soil, [name, inner]) {
    const own = entry.properties[name];
    return !inner ? own : (own.oneOf ? own.oneOf[branch_of(own.oneOf, soil[name])] : own).properties[inner];
}

/// All materials: the table, and below it each material with all entries.
export class Soils extends NamedRows {
    constructor(form, entry, parts, options) {
        super(form, entry, parts, options);
        this.soil = entry.additionalProperties;
        this.presets = this.soil["x-presets"] ?? [];
        this.lines = element("tbody");
        const widest = this.soil.properties.law.oneOf.find(({ properties }) => properties.c_kPa);
        const heads = columns.map(({ way, title }) => [title, entry_of(this.soil, { law: { type: widest.properties.type.const } }, way)]);
        this.table = element("table", { class: "soils" },
            element("thead", {}, element("tr", {}, element("td", { colspan: 2 }), element("th", { scope: "colgroup", colspan: 2 }, "stability"),
                                         element("th", { scope: "colgroup", colspan: 4 }, "deformation and runout")),
                element("tr", {}, element("th", { scope: "col" }, "soil"), ...heads.map(([title, each]) => element("th", { scope: "col", title: each.description },
                    title, element("span", { class: "range" }, unit_of(each) || "–"), element("span", { class: "range" }, plausible_of(each)))))), this.lines);
        this.element = element("div", { class: "members" }, this.table, this.fold.element);
    }

    update(value) {
        super.update(value);
        if (!this.table) return;
        const soils = Object.entries(value ?? {}).filter(([, soil]) => soil !== null && typeof soil === "object");
        this.table.hidden = soils.length === 0;
        mirror(this.lines, soils, ([name, soil]) => `${name} ${soil.law?.type}`, ([name, soil]) => this.make_line(name, soil), (line, [name, soil]) => {
            line.cells_of.forEach(({ way, cell }) => cell.update(way.reduce((inner, part) => inner?.[part], soil)));
            set_text(line.querySelector(".soil-source"), [soil.strength ? "strength by state, see below" : "", ...(soil.notes ?? [])].filter(Boolean).join("; "));
        });
    }

    make_line(name, soil) {
        const preset = element("select", { "aria-label": `preset of ${name}`, onchange: () => {
            this.take_preset(name, this.presets[preset.value]);
            preset.value = "";
        } }, element("option", { value: "" }, "preset…"),
            ...this.presets.map(({ title, source }, i) => element("option", { value: i, title: source }, `${title} (${source})`)));
        const line = element("tr", {}, element("th", { scope: "row" }, name, preset, element("span", { class: "soil-source muted" })));
        line.cells_of = [];
        for (const { way, title, of } of columns) {
            const entry = entry_of(this.soil, soil, way);
            if (!entry || (soil.strength && way[0] === "law" && way[1] !== "E_MPa")) {
                line.append(element("td", {}, "–"));
                continue;
            }
            const parts = [...this.parts, name, ...way];
            const cell = new Scalar(this.form, entry, parts, { name: way.at(-1) });
            cell.control.removeAttribute("aria-describedby");
            cell.control.setAttribute("aria-label", `${title} of ${name}`);
            cell.control.dataset.pointer = pointer_of(parts);
            if (of === "stability" && entry_of(this.soil, soil, ["law", way[1]])) {
                cell.control.placeholder = way[1] === "c_kPa" ? "c" : "φ";
                cell.control.title = "empty: that of deformation and runout";
            }
            line.cells_of.push({ way, cell });
            this.form.cells.set(pointer_of(parts), cell);
            line.append(element("td", { "data-title": `${of === "stability" ? "stability, " : ""}${title} [${unit_of(entry) || "–"}]` }, cell.control, cell.note, cell.slot));
        }
        return line;
    }

    /// Sets the preset's soil or that of a shipped scene, with its source as the first note.
    async take_preset(name, { title, example, material, source, soil: own }) {
        const { notes = [], ...soil } = own ?? (await read_example(example)).scene.materials[material];
        this.form.set([...this.parts, name], { notes: [`${title}: ${source}`, ...notes], ...soil });
    }
}

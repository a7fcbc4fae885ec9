// The variants of a study as a table: one row each, one column for each place of the scene that some of them change.
import { element, mirror, set_text } from "./dom.js";
import { Fold } from "./form_groups.js";
import { new_id } from "./form_fields.js";
import { parts_of, pointer_of } from "./json_text.js";
import { shape_of, takes_number, unit_of } from "./schema.js";

const split = (override) => {
    const at = override.indexOf("=");
    return at < 0 ? [override, ""] : [override.slice(0, at), override.slice(at + 1)];
};
const overrides_of = (variant) => (Array.isArray(variant?.overrides) ? variant.overrides : []).filter((each) => typeof each === "string");
const plain = (text) => text.toLowerCase().replace(/[^a-z0-9_-]+/g, "_").replace(/^[^a-z0-9]+/, "");

/// All single values that a scene has or may have: pointer -> its schema's entry.
export function places_of(entry, value, parts = []) {
    const kind = shape_of(entry);
    if (kind === "scalar" || kind === "tuple" || kind === "numbers") return [[pointer_of(parts), entry]];
    const inside = (each, name) => places_of(each, value?.[name], [...parts, name]);
    if (kind === "group" && (value !== undefined || parts.length === 0)) return Object.entries(entry.properties).flatMap(([name, each]) => inside(each, name));
    if (kind === "map") return Object.keys(value ?? {}).flatMap((name) => inside(entry.additionalProperties, name));
    if (kind === "rows") return (Array.isArray(value) ? value : []).flatMap((_, i) => inside(entry.items, String(i)));
    if (kind === "choice" && value?.type) {
        const branch = entry.oneOf.find((each) => each.properties?.type?.const === value.type);
        return branch ? places_of(branch, value, parts) : [];
    }
    return [];
}

export class VariantsTable {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required, value: undefined, new_columns: [] });
        const id = new_id();
        this.fold = new Fold("variants", { id, help: entry.description });
        this.element = this.fold.element;
        this.element.dataset.group = name;
        this.control = this.element.firstElementChild;
        this.slot = element("div", { class: "field-faults" });
        this.head = element("tr");
        this.rows = element("tbody");
        this.places = element("datalist", { id: `${id}-places` });
        this.pointer = element("input", { type: "text", id: `${id}-pointer`, class: "word", list: this.places.id, placeholder: "/materials/...", autocomplete: "off", spellcheck: "false" });
        this.sweep = element("input", { type: "text", id: `${id}-values`, class: "list", placeholder: "4, 6, 9, 13", autocomplete: "off" });
        this.note = element("p", { class: "doubt", role: "status", hidden: true });
        this.table = element("div", { class: "scroll" }, element("table", { class: "variants-table", "aria-label": "variants" }, element("thead", {}, this.head), this.rows));
        this.fold.body.append(this.slot, this.table,
            element("div", { class: "row" }, element("button", { type: "button", onclick: () => this.add() }, "Add variant")),
            element("fieldset", {}, element("legend", {}, "Change a parameter"),
                element("div", { class: "field" }, element("div", { class: "field-name" }, element("label", { for: this.pointer.id }, "parameter")), element("div", { class: "field-value" }, this.pointer, this.places)),
                element("div", { class: "field" }, element("div", { class: "field-name" }, element("label", { for: this.sweep.id }, "values of a sweep"), element("p", { class: "help" }, "a variant for each")),
                    element("div", { class: "field-value" }, this.sweep)),
                element("div", { class: "row" }, element("button", { type: "button", onclick: () => this.add_column() }, "Add column"),
                    element("button", { type: "button", onclick: () => this.add_sweep() }, "Add sweep")), this.note));
        this.pointer.addEventListener("focus", () => this.offer());
        this.fold.fill = () => this.draw();
    }

    variants() { return Array.isArray(this.value) ? this.value : []; }
    columns() {
        return [...new Set([...this.variants().flatMap((variant) => overrides_of(variant).map((each) => split(each)[0])), ...this.new_columns])];
    }
    scene_value(pointer) {
        return parts_of(pointer).reduce((value, part) => value?.[part], this.form.scene());
    }
    entry_of(pointer) {
        return new Map(places_of(this.form.schemas.scene, this.form.scene())).get(pointer);
    }
    offer() {
        this.places.replaceChildren(...places_of(this.form.schemas.scene, this.form.scene()).filter(([pointer]) => !/^\/(format|name|title)$/.test(pointer))
            .map(([pointer, entry]) => element("option", { value: pointer }, [entry.description, unit_of(entry) && `[${unit_of(entry)}]`].filter(Boolean).join(" "))));
    }
    say(text) {
        set_text(this.note, text);
        this.note.hidden = text === "";
    }

    // ---- changes

    wanted_pointer() {
        const pointer = this.pointer.value.trim();
        const entry = this.entry_of(pointer);
        this.say(entry ? "" : pointer === "" ? "Choose which parameter first." : `The scene has no entry ${pointer} to change.`);
        if (!entry) this.pointer.focus();
        return entry ? pointer : null;
    }
    add_column() {
        const pointer = this.wanted_pointer();
        if (pointer === null) return;
        this.new_columns.push(pointer);
        if (this.variants().length === 0) this.add();
        else this.draw();
        this.rows.querySelector(`input[data-pointer="${CSS.escape(pointer)}"]`)?.focus();
    }
    add_sweep() {
        const pointer = this.wanted_pointer();
        if (pointer === null) return;
        const values = this.sweep.value.split(/[\s,;]+/).filter(Boolean);
        const bad = takes_number(this.entry_of(pointer)) ? values.find((each) => !Number.isFinite(Number(each))) : undefined;
        if (values.length === 0 || bad !== undefined) {
            this.say(bad === undefined ? "Give the values, with commas between." : `"${bad}" is not a number.`);
            return this.sweep.focus();
        }
        const stem = plain(parts_of(pointer).at(-1)).slice(0, 18);
        const made = values.map((value) => ({ name: this.free_name(`${stem}_${plain(value.replace("-", "minus_"))}`), overrides: [`${pointer}=${value}`] }));
        this.form.set(this.parts, [...this.variants(), ...made]);
        this.sweep.value = "";
    }
    free_name(wanted) {
        const names = new Set(this.variants().map((variant) => variant?.name));
        let name = wanted.slice(0, 32);
        for (let i = 2; names.has(name); i += 1) name = `${wanted.slice(0, 28)}_${i}`;
        return name;
    }
    add() {
        this.form.insert(this.parts, this.variants().length, { name: this.free_name(`variant_${this.variants().length + 1}`), overrides: [] });
        this.rows.lastElementChild?.querySelector("input").focus();
    }
    take_cell(i, pointer, text) {
        const overrides = overrides_of(this.variants()[i]);
        const at = overrides.findIndex((each) => split(each)[0] === pointer);
        if (text === "" && at >= 0) this.form.remove([...this.parts, String(i), "overrides", String(at)]);
        else if (text !== "" && at >= 0) this.form.set([...this.parts, String(i), "overrides", String(at)], `${pointer}=${text}`);
        else if (text !== "") this.form.insert([...this.parts, String(i), "overrides"], overrides.length, `${pointer}=${text}`);
    }
    remove(i) {
        if (this.variants().length === 1) this.form.remove(this.parts);
        else this.form.remove([...this.parts, String(i)]);
        (this.rows.children[Math.min(i, this.rows.children.length - 1)]?.querySelector("input") ?? this.control).focus();
    }
    move(i, by) {
        if (i + by >= 0 && i + by < this.variants().length) this.form.swap(this.parts, i, i + by);
    }
    remove_column(pointer) {
        this.new_columns = this.new_columns.filter((each) => each !== pointer);
        const kept = this.variants().map((variant) => ({ ...variant, overrides: overrides_of(variant).filter((each) => split(each)[0] !== pointer) }));
        this.form.set(this.parts, kept);
        this.draw();
    }

    // ---- the table

    update(value) {
        this.value = value;
        set_text(this.fold.tag, this.variants().length ? String(this.variants().length) : "none");
        if (this.element.open || this.is_drawn) this.draw();
    }
    draw() {
        this.is_drawn = true;
        const columns = this.columns();
        this.table.hidden = this.variants().length === 0;
        mirror(this.head, ["name", ...columns, "tools"], (each) => each, (each) => this.make_head(each), (cell, each) => {
            if (each.startsWith("/")) set_text(cell.querySelector(".base"), `in the scene: ${JSON.stringify(this.scene_value(each)) ?? "not set"} ${unit_of(this.entry_of(each) ?? {})}`);
        });
        mirror(this.rows, this.variants().map((_, i) => i), (i) => i, (i) => this.make_row(i), (row, i) => this.show_row(row, i, columns));
    }
    make_head(each) {
        if (each === "tools") return element("th", { scope: "col" }, element("span", { class: "unseen" }, "change"));
        if (each === "name") return element("th", { scope: "col" }, "name");
        return element("th", { scope: "col" }, element("code", {}, each), element("span", { class: "base" }),
            element("button", { type: "button", class: "small", "aria-label": `remove column ${each}`, title: "remove", onclick: () => this.remove_column(each) }, "✕"));
    }
    make_row(i) {
        const tool = (text, name, act) => element("button", { type: "button", class: "small", "aria-label": `${name} variant ${i + 1}`, title: name, onclick: act }, text);
        const name = element("input", { type: "text", class: "word", "aria-label": `name of variant ${i + 1}`, autocomplete: "off", spellcheck: "false",
            onchange: () => this.form.set([...this.parts, String(i), "name"], name.value.trim()) });
        return element("tr", {}, element("th", { scope: "row", "data-key": "name" }, name, element("div", { class: "field-faults" })),
            element("td", { class: "row-tools", "data-key": "tools" }, tool("↑", "move up", () => this.move(i, -1)), tool("↓", "move down", () => this.move(i, 1)),
                tool("copy", "copy", () => this.form.insert(this.parts, i + 1, { ...this.variants()[i], name: this.free_name(`${this.variants()[i].name}_copy`) })),
                tool("✕", "remove", () => this.remove(i))));
    }
    show_row(row, i, columns) {
        const variant = this.variants()[i];
        const set = new Map(overrides_of(variant).map(split));
        mirror(row, ["name", ...columns, "tools"], (each) => each, (pointer) => element("td", {}, element("input", { type: "text", class: "number", "data-pointer": pointer, placeholder: "as the scene",
            "aria-label": `${pointer} of variant ${i + 1}`, autocomplete: "off", onchange: (event) => this.take_cell(i, pointer, event.target.value.trim()) })), (cell, each) => {
            const text = each === "name" ? variant?.name ?? "" : set.get(each) ?? "";
            const input = cell.querySelector("input");
            if (input && input.value !== text) input.value = text;
        });
    }

    /// Faults of a variant and its members are shown at its name.
    child(i) {
        this.draw();
        const row = this.rows.children[Number(i)];
        return row ? { element: row, slot: row.querySelector(".field-faults"), control: row.querySelector("input"), child: () => null } : null;
    }
    open() {
        this.element.open = true;
    }
    add_faults(count) {
        this.fold.count.hidden = count === 0;
        set_text(this.fold.count, count === 1 ? "1 fault" : `${count} faults`);
    }
}

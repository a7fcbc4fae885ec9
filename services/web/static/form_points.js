// A line or polygon of the section as a table of points [m]. Accepts cells pasted from a spreadsheet.
import { element, mirror } from "./dom.js";
import { Fold } from "./form_groups.js";
import { label_of, new_id } from "./form_fields.js";

const number_in = (text) => (text.trim() === "" ? NaN : Number(text));

/// [[x, y], ...] from lines of two numbers; null: anything else. Between tabs or semicolons a comma is a decimal comma; a single column
/// like 12,5 is not a list of points.
function points_in(text) {
    const in_cells = /[\t;]/.test(text);
    if (!in_cells && !/[.\s]/.test(text.trim().replaceAll(/\r?\n/g, ""))) return null;
    const rows = text.trim().split(/\r?\n/).map((line) => (in_cells ? line.trim().replaceAll(",", ".").split(/\s*[\t;]\s*/) : line.trim().split(/\s*,\s*|\s+/)).map(Number));
    return rows.length > 1 && rows.every((row) => row.length === 2 && row.every(Number.isFinite)) ? rows : null;
}

export class Points {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required, value: undefined });
        this.title = label_of(name, entry);
        this.fold = new Fold(this.title, { id: new_id(), help: entry.description, level: "group points" });
        this.element = this.fold.element;
        this.element.dataset.group = name;
        this.control = this.element.firstElementChild;
        this.slot = element("div", { class: "field-faults" });
        this.rows = element("tbody");
        this.fold.body.append(this.slot, element("div", { class: "scroll" }, element("table", { class: "points-table", onpaste: (event) => this.paste(event) }, element("thead", {}, element("tr", {},
            element("th", { scope: "col" }, "point"), element("th", { scope: "col" }, "x [m]"), element("th", { scope: "col" }, "y [m]"),
            element("th", { scope: "col" }, element("span", { class: "unseen" }, "change")))), this.rows)),
            element("button", { type: "button", onclick: () => this.add(this.value?.length ?? 0) }, "Add point"));
        this.fold.fill = () => this.draw();
    }

    update(value) {
        this.value = value;
        const count = Array.isArray(value) ? value.length : 0;
        this.fold.tag.textContent = count === 0 ? (value === undefined ? "not set" : "none") : `${count} points`;
        if (this.element.open || this.rows.firstElementChild) this.draw();
    }

    draw() {
        const points = Array.isArray(this.value) ? this.value : [];
        mirror(this.rows, points.map((_, i) => i), (i) => i, (i) => this.make_row(i), (row, i) => {
            row.querySelectorAll("input").forEach((input, axis) => {
                const own = points[i]?.[axis];
                if (number_in(input.value) !== own && !(document.activeElement === input && this.form.is_own)) input.value = own ?? "";
            });
        });
    }
    make_row(i) {
        const cell = (axis) => element("td", {}, element("input", { type: "text", inputmode: "decimal", class: "number", autocomplete: "off",
            "aria-label": `${this.title}, point ${i + 1}, ${axis ? "y" : "x"}`, oninput: (event) => this.take(i, axis, event.target) }));
        const tool = (text, name, act) => element("button", { type: "button", class: "small", "aria-label": `${name} point ${i + 1}`, title: name, onclick: act }, text);
        const slot = element("div", { class: "field-faults" });
        return element("tr", {}, element("th", { scope: "row" }, String(i + 1), slot), cell(0), cell(1), element("td", { class: "row-tools" },
            tool("↑", "move up", () => this.move(i, -1)), tool("↓", "move down", () => this.move(i, 1)),
            tool("+", "insert after", () => this.add(i + 1)), tool("✕", "remove", () => this.remove(i))));
    }

    take(i, axis, input) {
        const number = number_in(input.value);
        input.toggleAttribute("aria-invalid", !Number.isFinite(number));
        if (!Number.isFinite(number)) return;
        const last = this.value.length - 1;
        const is_ring = last > 2 && this.value[0]?.every?.((each, k) => each === this.value[last]?.[k]) && /ring/i.test(this.entry.description);
        this.form.set([...this.parts, String(i), String(axis)], number);
        // The first vertex of a closed ring is also its last.
        if (is_ring && (i === 0 || i === last)) this.form.set([...this.parts, String(last - i), String(axis)], number);
    }
    add(at) {
        const points = Array.isArray(this.value) ? this.value : [];
        const [before, after] = [points[at - 1], points[at]];
        this.form.insert(this.parts, at, before && after ? before.map((each, k) => Number(((each + after[k]) / 2).toPrecision(9))) : before ?? [0, 0]);
        this.rows.children[at]?.querySelector("input").focus();
    }
    remove(i) {
        if (this.value.length === 1 && !this.required) this.form.remove(this.parts);
        else this.form.remove([...this.parts, String(i)]);
        (this.rows.children[Math.min(i, this.value?.length - 1)]?.querySelector("input") ?? this.control).focus();
    }
    move(i, by) {
        if (this.value[i + by] === undefined) return;
        this.form.swap(this.parts, i, i + by);
        this.rows.children[i + by].querySelector("input").focus();
    }
    paste(event) {
        const points = points_in(event.clipboardData.getData("text"));
        if (!points) return;
        event.preventDefault();
        this.form.set(this.parts, points);
    }

    /// A fault of one point is shown in its row.
    child(i) {
        this.draw();
        const row = this.rows.children[Number(i)];
        return row ? { element: row, slot: row.querySelector(".field-faults"), control: row.querySelector("input"), child: () => null, value: this.value[i] } : null;
    }
    open() {
        this.element.open = true;
    }
    add_faults(count) {
        this.fold.count.hidden = count === 0;
        this.fold.count.textContent = count === 1 ? "1 fault" : `${count} faults`;
    }
}

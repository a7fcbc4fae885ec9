// Single entries of the form: a number, a word, a few numbers side by side, or a list. Each is an element with label, unit, range and help.
// update(value) shows the document's value; an input calls form.set or form.remove.
import { element, set_text } from "./dom.js";
import { default_of, doubt_about, range_of, shape_of, takes_number, unit_of, words_of } from "./schema.js";

let count = 0;
export const new_id = () => `field-${(count += 1)}`;

const unit_endings = { MPa: "MPa", kPa: "kPa", deg: "deg", MB: "MB", s: "s", kN: "kN/m" };
/// A name for display, without the unit that is shown beside the field.
export function label_of(name, entry) {
    const [, stem, ending] = name.match(/^(.+)_([A-Za-z]+)$/) ?? [];
    return (stem && unit_endings[ending] === unit_of(entry) ? stem : name).replaceAll("_", " ");
}

const short = 60; // [characters] of help shown without opening

/// The help of an entry: one line, in full when opened.
export function help_of(text, id) {
    if (!text) return null;
    const line = element("p", { class: "help", id: `${id}-help` }, text);
    if (text.length <= short) return line;
    const more = element("button", { type: "button", class: "link more", "aria-expanded": "false", "aria-controls": `${id}-help`,
        onclick: () => more.setAttribute("aria-expanded", String(line.classList.toggle("open"))) }, element("span", { class: "unseen" }, "explain"), "?");
    line.classList.add("long");
    return element("div", { class: "help-row" }, line, more);
}

/// Label and help beside `inputs`, with room for faults.
export function field_of(part, id, inputs) {
    const { entry, name, required } = part;
    const title = `/${part.parts.join("/")}`;
    part.note = element("p", { class: "doubt", hidden: true });
    part.slot = element("div", { class: "field-faults", id: `${id}-faults` });
    return element("div", { class: "field" },
        element("div", { class: "field-name" }, element("label", { for: id, title }, label_of(name, entry), required ? element("span", { class: "required", title: "required" }, " *") : null),
                help_of(entry.description, id)),
        element("div", { class: "field-value" }, ...inputs, part.note, part.slot));
}

function say_doubt(part, text) {
    set_text(part.note, text);
    part.note.hidden = text === "";
}

/// Parses typed numbers and words: {value}; {}: empty; null: invalid so far.
function read(entry, text) {
    const trimmed = text.trim();
    if (trimmed === "") return {};
    if (!takes_number(entry)) return { value: trimmed === text ? text : trimmed };
    const number = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(trimmed) ? Number(trimmed) : NaN;
    if (Number.isFinite(number)) return { value: number };
    return words_of(entry).includes(trimmed) ? { value: trimmed } : null;
}
const written = (value) => (value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value));

const facts = (entry) => [unit_of(entry) && element("span", { class: "unit" }, unit_of(entry)),
                          range_of(entry) && element("span", { class: "range" }, range_of(entry))].filter(Boolean);

export class Scalar {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required });
        const id = new_id();
        this.control = this.is_choice() ? this.make_select(id) : this.make_input(id);
        this.element = field_of(this, id, [this.control, ...(this.list ? [this.list] : []), ...facts(entry)]);
        if (entry.description) this.control.setAttribute("aria-describedby", `${id}-help ${id}-faults`);
    }
    child() { return null; }
    is_choice() {
        return this.entry.type === "boolean" || (words_of(this.entry).length > 0 && !takes_number(this.entry));
    }

    make_select(id) {
        this.words = this.entry.type === "boolean" ? [true, false] : words_of(this.entry);
        const names = this.words.map((word) => (word === true ? "yes" : word === false ? "no" : String(word)));
        return element("select", { id, onchange: () => this.take_choice() },
            element("option", { value: "" }, default_of(this.entry) || "not set"),
            ...names.map((name, i) => element("option", { value: i }, name)));
    }
    take_choice() {
        if (this.control.value === "other") return;
        if (this.control.value === "") this.form.remove(this.parts);
        else this.form.set(this.parts, this.words[Number(this.control.value)]);
    }

    make_input(id) {
        const words = words_of(this.entry);
        if (words.length) this.list = element("datalist", { id: `${id}-words` }, ...words.map((word) => element("option", { value: word })));
        const numeric = takes_number(this.entry);
        return element("input", { id, type: "text", class: numeric ? "number" : "word", inputmode: numeric && !this.list ? "decimal" : null, autocomplete: "off",
            spellcheck: "false", list: this.list ? this.list.id : this.form.names_for(this.parts), placeholder: default_of(this.entry) || null,
            oninput: () => this.take(false), onchange: () => this.take(true) });
    }

    take(is_done) {
        const found = read(this.entry, this.control.value);
        say_doubt(this, found ? doubt_about(this.entry, found.value) : is_done ? "this is not a number" : "");
        if (!found) return;
        if (found.value === this.value) return; // also events of a field that is being removed
        if ("value" in found) this.form.set(this.parts, found.value);
        else if (is_done) this.form.remove(this.parts);
    }

    update(value) {
        this.value = value;
        if (this.is_choice()) return this.show_choice(value);
        say_doubt(this, doubt_about(this.entry, value));
        const known = read(this.entry, this.control.value);
        if (known?.value === value && (document.activeElement === this.control || value !== undefined)) return;
        if (document.activeElement === this.control && this.form.is_own) return; // incomplete input
        this.control.value = written(value);
    }
    show_choice(value) {
        const at = this.words.indexOf(value);
        const is_other = value !== undefined && at < 0;
        this.control.querySelector("[value=other]")?.remove();
        if (is_other) this.control.append(element("option", { value: "other" }, JSON.stringify(value)));
        this.control.value = is_other ? "other" : value === undefined ? "" : String(at);
    }
}

const of_tuple = { domain_x: ["from", "to"], domain_y: ["from", "to"], default: ["x", "y"] };
function tuple_names(entry, name) {
    if (of_tuple[name]) return of_tuple[name];
    if (/\bx \(.*y \(|in x and y/.test(entry.description)) return ["x", "y"];
    if (/from, to|lower and upper/.test(entry.description)) return ["from", "to"];
    return Array.from({ length: entry.maxItems }, (_, i) => String(i + 1));
}

/// Two to four numbers, written once all are present.
export class Tuple {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required });
        const id = new_id();
        this.inputs = tuple_names(entry, name).map((each, i) => element("input", { id: i ? `${id}-${i}` : id, type: "text", inputmode: "decimal", class: "number",
            autocomplete: "off", "aria-label": `${label_of(name, entry)}: ${each}`, placeholder: entry.default ? String(entry.default[i]) : each,
            oninput: () => this.take(i, false), onchange: () => this.take(i, true) }));
        this.control = this.inputs[0];
        this.element = field_of(this, id, [element("span", { class: "tuple" }, ...this.inputs), ...facts({ ...entry.items, unit: unit_of(entry) || entry.items.unit })]);
    }
    child() { return null; }

    take(i, is_done) {
        const numbers = this.inputs.map((input) => read(this.entry.items, input.value));
        say_doubt(this, numbers.includes(null) ? (is_done ? "this is not a number" : "") : numbers.map((each) => doubt_about(this.entry.items, each.value)).find(Boolean) ?? "");
        if (numbers.every((each) => each && !("value" in each))) return is_done ? this.form.remove(this.parts) : null;
        if (!numbers.every((each) => each && "value" in each)) return null;
        if (Array.isArray(this.value) && this.value.length === numbers.length) return this.form.set([...this.parts, String(i)], numbers[i].value);
        return this.form.set(this.parts, numbers.map((each) => each.value));
    }

    update(value) {
        if (value === undefined && this.value === undefined) return; // keep incomplete input
        this.value = value;
        this.inputs.forEach((input, i) => {
            if (read(this.entry.items, input.value)?.value !== value?.[i] && !(document.activeElement === input && this.form.is_own)) input.value = written(value?.[i]);
        });
    }
}

/// Numbers or words in one line, separated by commas.
export class List {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required });
        const id = new_id();
        this.numeric = shape_of(entry) === "numbers";
        const allowed = words_of(entry.items);
        this.control = element("input", { id, type: "text", class: "list", autocomplete: "off", spellcheck: "false", placeholder: default_of(entry) || "with commas between",
            title: allowed.length ? `of ${allowed.join(", ")}` : null, list: this.form.names_for(parts), onchange: () => this.take() });
        this.element = field_of(this, id, [this.control, ...facts(entry)]);
        if (allowed.length) this.element.querySelector(".field-name").append(element("p", { class: "help open" }, `of ${allowed.join(", ")}`));
    }
    child() { return null; }

    take() {
        // Between semicolons a comma may be a decimal comma: a fault, not two numbers.
        const between = !this.numeric ? /\s*[,;]\s*/ : this.control.value.includes(";") ? /[\s;]+/ : /[\s,]+/;
        const pieces = this.control.value.split(between).filter(Boolean);
        const values = this.numeric ? pieces.map((piece) => read({ type: "number" }, piece)?.value) : pieces;
        const bad = pieces[values.indexOf(undefined)];
        say_doubt(this, bad === undefined ? "" : `"${bad}" is not a number`);
        if (bad !== undefined) return;
        if (values.length === 0) this.form.remove(this.parts);
        else this.form.set(this.parts, values);
    }

    update(value) {
        const text = Array.isArray(value) ? value.map(written).join(", ") : written(value);
        if (document.activeElement !== this.control || !this.form.is_own) this.control.value = text;
    }
}

/// An entry without a known shape, as JSON.
export class Text {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required });
        const id = new_id();
        this.control = element("input", { id, type: "text", class: "list", autocomplete: "off", spellcheck: "false", onchange: () => this.take() });
        this.element = field_of(this, id, [this.control]);
    }
    child() { return null; }
    take() {
        try {
            if (this.control.value.trim() === "") this.form.remove(this.parts);
            else this.form.set(this.parts, JSON.parse(this.control.value));
            say_doubt(this, "");
        } catch (fault) {
            if (!(fault instanceof SyntaxError)) throw fault;
            say_doubt(this, `not JSON: ${fault.message}`);
        }
    }
    update(value) {
        this.control.value = value === undefined ? "" : JSON.stringify(value);
    }
}

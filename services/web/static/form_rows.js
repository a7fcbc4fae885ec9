// Lists and maps of the document as rows to add, copy, move, rename and remove.
import { element, set_text } from "./dom.js";
import { Fold, Members } from "./form_groups.js";
import { label_of, new_id } from "./form_fields.js";
import { shape_of, skeleton } from "./schema.js";

const button = (text, name, act) => element("button", { type: "button", class: "small", "aria-label": name, title: name, onclick: act }, text);

/// Title of a row: its name, its number, or its subject.
function title_of(value, place) {
    if (value === null || typeof value !== "object") return String(value ?? place);
    const named = value.name ?? value.region ?? value.parameter ?? value.to ?? value.kind;
    const kind = value.type && value.type !== named ? ` · ${value.type}` : value.material ? ` · ${value.material}` : "";
    return `${typeof named === "string" ? named : place}${kind}`;
}

/// One row: its head with tools, and its fields when opened. tools: buttons; head: a field before the others; one: singular name of a row.
class Row {
    constructor(form, entry, parts, { tools, head = null, one = "" }) {
        Object.assign(this, { form, entry, parts, one });
        this.fold = new Fold("", { id: new_id(), level: "item" });
        this.fold.fill = () => this.fill();
        this.slot = element("div", { class: "field-faults" });
        this.fold.body.append(...(head ? [head] : []), this.slot);
        this.control = this.fold.element.firstElementChild;
        this.element = element("li", { class: "form-row" }, this.fold.element, element("span", { class: "row-tools" }, ...tools));
    }

    fill() {
        if (this.inner) return;
        if (shape_of(this.entry) === "group") {
            this.inner = new Members(this.form, this.entry, this.parts);
            this.inner.make(this.value);
        } else {
            this.inner = this.form.make(this.entry, this.parts, { name: shape_of(this.entry) === "choice" ? "kind" : this.one, required: true });
            this.inner.update(this.value);
        }
        this.fold.body.append(this.inner.element);
    }
    update(value, place) {
        this.value = value;
        set_text(this.fold.title, title_of(value, place));
        this.inner?.update(value);
    }
    child(name) {
        this.fill();
        return this.inner.child(name);
    }
    open(name) {
        this.fold.element.open = true;
        (this.inner?.open_for ?? this.inner?.open)?.call(this.inner, name);
    }
    add_faults(count) {
        this.fold.count.hidden = count === 0;
        set_text(this.fold.count, count === 1 ? "1 fault" : `${count} faults`);
    }
}

class Container {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required, rows: [] });
        const id = new_id();
        this.fold = new Fold(form.title_of?.(parts) ?? label_of(name, entry), { id, help: entry.description });
        this.element = this.fold.element;
        this.element.dataset.group = name;
        this.control = this.element.firstElementChild;
        this.slot = element("div", { class: "field-faults" });
        this.list = element("ul", { class: "rows" });
        this.fold.body.append(this.slot, this.list, ...this.adding(id));
    }
    say_count(count) {
        set_text(this.fold.tag, count === 0 ? "none" : String(count));
    }
    open() {
        this.fold.element.open = true;
    }
    add_faults(count) {
        Row.prototype.add_faults.call(this, count);
    }
}

export class Rows extends Container {
    adding() {
        const singular = label_of(this.name, this.entry).replace(/ies$/, "y").replace(/([^s])s$/, "$1");
        this.one = singular;
        return [element("button", { type: "button", onclick: () => this.add(skeleton(this.entry.items)) }, `Add ${singular}`)];
    }
    length() { return this.rows.length; }
    add(value) {
        const at = this.length();
        this.form.insert(this.parts, at, value);
        this.rows[at]?.open();
        this.rows[at]?.control.focus();
    }
    remove(i) {
        if (this.length() === 1 && !this.required) this.form.remove(this.parts);
        else this.form.remove([...this.parts, String(i)]);
        (this.rows[Math.min(i, this.length() - 1)]?.control ?? this.control).focus();
    }
    move(i, by) {
        if (!this.rows[i + by]) return;
        this.form.swap(this.parts, i, i + by);
        const [was, is] = [this.rows[i], this.rows[i + by]].map((row) => row.fold.element);
        [was.open, is.open] = [is.open, was.open];
        this.rows[i + by].element.querySelector(`[data-by="${by}"]`).focus();
    }

    make_row(i) {
        const tool = (text, name, act, by) => {
            const made = button(text, `${name} ${this.one} ${i + 1}`, act);
            if (by) made.dataset.by = by;
            return made;
        };
        return new Row(this.form, this.entry.items, [...this.parts, String(i)],
            { one: this.one, tools: [tool("↑", "move up", () => this.move(i, -1), -1), tool("↓", "move down", () => this.move(i, 1), 1),
                tool("copy", "copy", () => this.form.insert(this.parts, i + 1, this.rows[i].value)), tool("✕", "remove", () => this.remove(i))] });
    }

    update(value) {
        const items = Array.isArray(value) ? value : [];
        while (this.rows.length > items.length) this.rows.pop().element.remove();
        while (this.rows.length < items.length) {
            this.rows.push(this.make_row(this.rows.length));
            this.list.append(this.rows.at(-1).element);
        }
        items.forEach((item, i) => this.rows[i].update(item, `${this.one} ${i + 1}`));
        this.say_count(items.length);
    }
    child(i) { return this.rows[Number(i)] ?? null; }
}

/// Named entries: materials. A rename also changes references to the old name.
export class NamedRows extends Container {
    adding(id) {
        this.named = new Map();
        this.wanted = element("input", { type: "text", id: `${id}-new`, class: "word", autocomplete: "off", spellcheck: "false",
            onkeydown: (event) => event.key === "Enter" && this.add() });
        return [element("p", { class: "row" }, element("label", { for: this.wanted.id }, "Name of a new one"), this.wanted,
                        element("button", { type: "button", onclick: () => this.add() }, "Add"))];
    }
    add() {
        const name = this.wanted.value.trim();
        if (name === "" || this.named.has(name)) return this.wanted.focus();
        this.form.set([...this.parts, name], skeleton(this.entry.additionalProperties));
        this.wanted.value = "";
        this.named.get(name)?.open();
        this.named.get(name)?.control.focus();
    }
    copy(name) {
        let other = `${name}_copy`;
        while (this.named.has(other)) other += "_";
        this.form.set([...this.parts, other], this.named.get(name).value);
    }
    rename(name, input) {
        const other = input.value.trim();
        if (other === name) return;
        if (other === "" || this.named.has(other)) {
            input.value = name;
            return;
        }
        this.form.rename([...this.parts, name], other);
        this.named.get(other)?.open();
    }

    make_row(name) {
        const id = new_id();
        const input = element("input", { id, type: "text", class: "word", autocomplete: "off", spellcheck: "false", value: name,
                                         onchange: () => this.rename(name, input) });
        return new Row(this.form, this.entry.additionalProperties, [...this.parts, name],
            { tools: [button("copy", `copy ${name}`, () => this.copy(name)), button("✕", `remove ${name}`, () => this.form.remove([...this.parts, name]))],
              head: element("div", { class: "field" }, element("div", { class: "field-name" }, element("label", { for: id }, "name")), element("div", { class: "field-value" }, input)) });
    }

    update(value) {
        const names = Object.keys(value ?? {});
        for (const [name, row] of this.named) {
            if (names.includes(name)) continue;
            row.element.remove();
            this.named.delete(name);
        }
        names.forEach((name, i) => {
            if (!this.named.has(name)) this.named.set(name, this.make_row(name));
            const row = this.named.get(name);
            if (this.list.children[i] !== row.element) this.list.insertBefore(row.element, this.list.children[i] ?? null);
            row.update(value[name], name);
            set_text(row.fold.title, `${name}${value[name]?.law?.type ? ` · ${value[name].law.type}` : ""}`);
        });
        this.say_count(names.length);
    }
    child(name) { return this.named.get(name) ?? null; }
}

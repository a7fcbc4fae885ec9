// Entries with members: collapsible groups, and choices between shapes. Members are created when they are first shown.
import { element, mirror, set_text } from "./dom.js";
import { field_of, help_of, label_of, new_id } from "./form_fields.js";
import { branch_name, branch_of, shape_of, skeleton } from "./schema.js";

/// In a study and a scene: shown even when not set.
const always = new Set(["title", "transfer_times", "variants", "lem", "fem", "transfer", "mpm"]);

/// The members of an object in the schema's order: set or required ones first, the rest below "more".
export class Members {
    constructor(form, entry, parts) {
        Object.assign(this, { form, entry, parts, inside: new Map(), element: element("div", { class: "members" }) });
        this.unknown = element("div", { class: "unknown" });
    }

    make(value) {
        const required = new Set(this.entry.required ?? []);
        const late = [];
        for (const [name, each] of Object.entries(this.entry.properties)) {
            if (shape_of(each) === "constant") continue;
            const parts = [...this.parts, name];
            const part = this.form.make(each, parts, { name, required: required.has(name) });
            const steps = this.form.steps_of?.(parts);
            if (steps) part.element.dataset.steps = steps;
            this.inside.set(name, part);
            const is_shown = required.has(name) || value?.[name] !== undefined || this.form.shows_all || (this.parts.length < 2 && always.has(name));
            if (is_shown) this.element.append(part.element);
            else late.push(part);
        }
        for (const some of Map.groupBy(late, (part) => part.element.dataset.steps).values()) this.element.append(...(some.length < 3 ? some.map((part) => part.element) : [this.fold_of(some)]));
        this.element.append(this.unknown);
        this.update(value);
    }
    /// A fold for parts of one step.
    fold_of(parts) {
        const names = parts.map((part) => label_of(part.name, part.entry));
        const { steps } = parts[0].element.dataset;
        return element("details", { class: "more-members", "data-steps": steps },
            element("summary", {}, `${parts.length} more: ${names.slice(0, 5).join(", ")}${names.length > 5 ? ", …" : ""}`), element("div", { class: "members" }, ...parts.map((part) => part.element)));
    }
    /// The fold that contains an entry; null: none.
    fold_around(name) {
        const fold = this.inside.get(name)?.element.closest(".more-members");
        return fold?.parentElement === this.element ? fold : null;
    }

    update(value) {
        for (const [name, part] of this.inside) {
            part.update(value?.[name]);
            // Entries that another text sets move out of "more".
            if (value?.[name] !== undefined && !this.form.is_own) this.fold_around(name)?.before(part.element);
        }
        const names = Object.keys(value ?? {}).filter((name) => !(name in this.entry.properties));
        mirror(this.unknown, names, (name) => name, (name) => element("p", {}, element("code", {}, name), " is not known to this form; it stays in the JSON. ",
            element("button", { type: "button", onclick: () => this.form.remove([...this.parts, name]) }, `Remove ${name}`)), () => {});
    }
    child(name) { return this.inside.get(name) ?? null; }
    open_for(name) {
        const fold = this.fold_around(name);
        if (fold) fold.open = true;
    }
}

/// A title that opens a body. `fill(body)` is called once, when the body is first needed.
export class Fold {
    constructor(title, { id, help = "", level = "group" }) {
        this.tag = element("span", { class: "tag" });
        this.count = element("span", { class: "fault-count", hidden: true });
        this.title = element("span", { class: "fold-title" }, title);
        this.body = element("div", { class: "fold-body", id });
        this.element = element("details", { class: level, ontoggle: (event) => event.target === this.element && this.element.open && this.fill?.() },
            element("summary", {}, this.title, " ", this.tag, " ", this.count), this.body);
        if (help) this.body.append(help_of(help, id));
    }
}

/// An object of the document.
export class Group {
    constructor(form, entry, parts, { name, required = false, is_open = false, title = null }) {
        Object.assign(this, { form, entry, parts, name, required });
        this.fold = new Fold(title ?? form.title_of?.(parts) ?? label_of(name, entry), { id: new_id(), help: entry.description });
        this.fold.fill = () => this.fill();
        this.element = this.fold.element;
        this.slot = element("div", { class: "field-faults" });
        this.control = this.element.firstElementChild;
        this.element.dataset.group = name;
        this.tools = element("div", { class: "row tools" });
        this.fold.body.append(this.slot, this.tools);
        if (is_open) this.element.open = true;
    }

    fill() {
        if (this.members) return;
        this.members = new Members(this.form, this.entry, this.parts);
        this.fold.body.append(this.members.element);
        this.is_made = false;
        this.update(this.value);
    }

    /// A missing optional object has only a button to add it.
    update(value) {
        this.value = value;
        const is_there = value !== undefined || this.required;
        set_text(this.fold.tag, is_there ? "" : "not set");
        this.element.classList.toggle("absent", !is_there);
        if (!this.members) return;
        this.members.element.hidden = !is_there;
        this.show_tools(is_there);
        if (!is_there) return;
        if (this.is_made) return this.members.update(value);
        this.is_made = true;
        this.members.make(value);
    }
    show_tools(is_there) {
        if (this.required || this.shows === is_there) return;
        this.shows = is_there;
        const name = label_of(this.name, this.entry);
        this.tools.replaceChildren(is_there
            ? element("button", { type: "button", onclick: () => this.form.remove(this.parts) }, `Remove ${name}`)
            : element("button", { type: "button", onclick: () => this.form.set(this.parts, skeleton(this.entry)) }, `Add ${name}`));
    }

    child(name) {
        this.fill();
        return this.is_made ? this.members.child(name) : null;
    }
    open(name) {
        this.element.open = true;
        if (name !== undefined) this.members?.open_for(name);
    }
    add_faults(count) {
        this.fold.count.hidden = count === 0;
        set_text(this.fold.count, count === 1 ? "1 fault" : `${count} faults`);
    }
}

/// Converts between a list and a range of times.
function converted(value, branch) {
    if (Array.isArray(value) && branch.properties?.step && value.length > 1) {
        const [from, to] = [Math.min(...value), Math.max(...value)];
        return { from, to, step: Number(((to - from) / (value.length - 1)).toPrecision(6)) };
    }
    if (branch.type === "array" && value?.step > 0 && value.to >= value.from) {
        const last = Math.min(Math.floor((value.to - value.from) / value.step + 1e-9), 9999);
        return Array.from({ length: last + 1 }, (_, i) => Number((value.from + i * value.step).toPrecision(12)));
    }
    return skeleton(branch);
}

/// An entry with one of several shapes: the choice, and the fields of the chosen shape.
export class Choice {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required, at: null });
        const id = new_id();
        this.control = element("select", { id, onchange: () => this.take() }, element("option", { value: "" }, "not set"),
            ...entry.oneOf.map((branch, i) => element("option", { value: i }, branch_name(branch))));
        this.body = element("div", { class: "members" });
        this.element = element("div", { class: "choice" }, field_of(this, id, [this.control]), this.body);
    }

    take() {
        const branch = this.entry.oneOf[Number(this.control.value)];
        if (this.control.value === "") return this.form.remove(this.parts);
        const type = branch.properties?.type?.const;
        if (type && this.value) return this.form.set([...this.parts, "type"], type); // keep common members
        return this.form.set(this.parts, converted(this.value, branch));
    }

    update(value) {
        this.value = value;
        const at = value === undefined ? null : branch_of(this.entry.oneOf, value);
        this.control.value = at === null ? "" : String(at);
        if (at === null) this.body.replaceChildren();
        else if (at === this.at) return this.inner.update(value);
        else this.show(this.entry.oneOf[at], value);
        this.at = at;
    }
    show(branch, value) {
        if (branch.properties) {
            this.inner = new Members(this.form, branch, this.parts);
            this.inner.make(value);
        } else {
            this.inner = this.form.make({ ...branch, description: "" }, this.parts, { name: branch_name(branch) });
            this.inner.update(value);
        }
        this.body.replaceChildren(this.inner.element);
    }
    child(name) { return this.at === null ? null : this.inner.child(name); }
    open(name) {
        this.inner?.open_for?.(name);
    }
}

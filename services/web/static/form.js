// The form beside the JSON, made from the served schemas: shows and edits the text. The text is the document; the form stores nothing.
import { by_id, element, set_text } from "./dom.js";
import { FileField, is_file } from "./form_files.js";
import { List, Scalar, Text, Tuple } from "./form_fields.js";
import { Choice, Group, Members } from "./form_groups.js";
import { Points } from "./form_points.js";
import { NamedRows, Rows } from "./form_rows.js";
import { insert_item, parts_of, pointer_of, remove_value, rename_member, set_value, swap_items } from "./json_text.js";
import { steps_of, title_of } from "./path.js";
import { read_schemas, shape_of } from "./schema.js";
import { Soils } from "./soils.js";
import { VariantsTable } from "./variants_table.js";

const makers = { scalar: Scalar, tuple: Tuple, numbers: List, words: List, points: Points, rows: Rows, map: NamedRows, group: Group, choice: Choice, text: Text };

/// Entries with the name of a material or a region.
const names_materials = new Set(["material", "to", "saturated", "like"]);
const names_regions = new Set(["region", "regions"]);

/// The service reports a missing entry at its object; the form shows it at the entry's field.
function place_of(pointer, cause) {
    const missing = cause.match(/^lacks "([^"]+)"/)?.[1];
    return missing ? pointer + pointer_of([missing]) : pointer;
}

/// Shows a fault at a part of the form.
export function say_fault(part, { cause, remedy, is_warning }) {
    part.slot?.append(element("p", {}, element("strong", {}, cause), remedy ? ` ${remedy}` : ""));
    if (is_warning || !part.control?.matches("input, select")) return;
    part.control.setAttribute("aria-invalid", "true");
    part.control.dataset.fault = "";
}
export function forget_faults(root) {
    for (const slot of root.querySelectorAll(".field-faults")) slot.replaceChildren();
    for (const control of root.querySelectorAll("[data-fault]")) {
        control.removeAttribute("aria-invalid");
        delete control.dataset.fault;
    }
}

export class Form {
    /// edit(change, kind): replaces the text by change(text); consecutive edits of one kind are one undo step. looked_at(pointer): called
    /// with the user's place. enter(pointer): called to show the step of a place.
    constructor(edit, looked_at, enter) {
        Object.assign(this, { edit_text: edit, enter, element: by_id("form"), faults: [], is_own: false, cells: new Map() });
        this.names = { materials: element("datalist", { id: "names-of-materials" }), regions: element("datalist", { id: "names-of-regions" }) };
        this.element.after(...Object.values(this.names));
        this.element.addEventListener("focusin", (event) => {
            const title = event.target.dataset.pointer ?? event.target.closest(".field")?.querySelector("label")?.title;
            if (title) looked_at(title);
        });
    }

    async start() {
        this.schemas ??= await read_schemas();
    }

    make(entry, parts, options) {
        if (parts.length === 1 && parts[0] === "variants") return new VariantsTable(this, entry, parts, options);
        if (is_file(entry)) return new FileField(this, entry, parts, options);
        if (parts.length === 1 && parts[0] === "scene") return new Group(this, entry, parts, { ...options, is_open: true });
        if (this.place(parts) === "/scene/materials") return new Soils(this, entry, parts, options);
        return new makers[shape_of(entry)](this, entry, parts, options);
    }
    /// Pointer within the study.
    place(parts) { return pointer_of(this.is_study ? parts : ["scene", ...parts]); }
    steps_of(parts) { return parts.length > 3 ? null : steps_of(this.place(parts)).join(" "); }
    title_of(parts) { return title_of(this.place(parts)); }

    // ---- edits

    edit(change, kind) {
        this.is_own = true;
        try {
            this.edit_text(change, kind);
        } finally {
            this.is_own = false;
        }
    }
    set(parts, value) { this.edit((text) => set_value(text, parts, value), `set ${pointer_of(parts)}`); }
    remove(parts) { this.edit((text) => remove_value(text, parts)); }
    insert(parts, at, value) { this.edit((text) => insert_item(text, parts, at, value)); }
    swap(parts, one, other) { this.edit((text) => swap_items(text, parts, one, other)); }

    /// Renames references to the entry as well.
    rename(parts, name) {
        const old = parts.at(-1);
        const uses = [];
        const look = (value, way) => {
            if (value === old && names_materials.has(way.at(-1))) uses.push(way);
            if (value !== null && typeof value === "object") for (const [key, each] of Object.entries(value)) look(each, [...way, key]);
        };
        look(this.scene(), parts.slice(0, -2));
        this.edit((text) => uses.reduce((changed, way) => set_value(changed, way, name), rename_member(text, parts, name)));
    }

    // ---- content of the text

    scene() { return this.is_study ? this.value?.scene : this.value; }
    names_for(parts) {
        const name = parts.at(-1);
        return names_materials.has(name) ? this.names.materials.id : names_regions.has(name) ? this.names.regions.id : null;
    }

    /// text: of the editor. If it is not JSON, the form stays unchanged.
    show(text) {
        if (!this.schemas) return;
        let value;
        try {
            value = JSON.parse(text);
        } catch {
            return this.wait(text.trim() === "" ? "Nothing yet: begin in step 1." : "The text is not JSON at the moment; the form waits until it is.", text);
        }
        if (value === null || typeof value !== "object" || Array.isArray(value)) return this.wait("A study is an object: { ... }.", text);
        this.value = value;
        this.say("");
        const is_study = !String(value.format).startsWith("breachline-scene");
        if (!this.root || is_study !== this.is_study) this.begin(is_study);
        this.root.update(value);
        this.fill_names();
        this.faults = this.faults.filter((fault) => JSON.stringify(this.value_at(fault.pointer)) === fault.was);
        this.mark();
    }
    begin(is_study) {
        this.is_study = is_study;
        this.cells.clear();
        this.root = new Members(this, is_study ? this.schemas.study : this.schemas.scene, []);
        this.root.make(this.value);
        this.element.replaceChildren(this.root.element);
    }
    wait(why, text) {
        this.say(why);
        if (text.trim() !== "") return;
        this.root = null;
        this.value = undefined;
        this.faults = [];
        this.element.replaceChildren(element("button", { type: "button", "data-steps": "section", onclick: () => this.edit(() => "{\n    \"format\": \"breachline-study/1\",\n    \"name\": \"my-dam\",\n" +
            "    \"scene\": {\n        \"format\": \"breachline-scene/1\",\n        \"name\": \"my-dam\",\n        \"materials\": {},\n        \"section\": { \"regions\": [] }\n    }\n}") }, "Begin an empty study"));
    }
    say(why) {
        set_text(by_id("form-note"), why);
        this.element.inert = why !== "" && this.root !== null;
        this.element.classList.toggle("stale", this.element.inert);
    }
    value_at(pointer) {
        return parts_of(pointer).reduce((value, part) => value?.[part], this.value);
    }
    fill_names() {
        const scene = this.scene() ?? {};
        const found = { materials: Object.keys(scene.materials ?? {}), regions: (Array.isArray(scene.section?.regions) ? scene.section.regions : []).map((region) => region?.name) };
        for (const [kind, list] of Object.entries(this.names)) list.replaceChildren(...found[kind].filter(Boolean).map((name) => element("option", { value: name })));
    }

    // ---- faults

    /// Replaces the faults of one source ("drawing", "submission").
    take_faults(source, faults) {
        const fresh = faults.map((fault) => ({ ...fault, source, was: JSON.stringify(this.value_at(fault.pointer)) }));
        this.faults = [...this.faults.filter((fault) => fault.source !== source), ...fresh];
        this.mark();
    }

    /// Parts of the form on the path to a place, as far as they exist; creates them.
    way_to(pointer) {
        const way = [];
        let part = this.root;
        for (const name of parts_of(pointer)) {
            part = part?.child(name);
            if (!part) break;
            way.push([part, name]);
        }
        return way;
    }

    mark() {
        forget_faults(this.element);
        const counts = new Map(this.counted);
        for (const [part] of counts) counts.set(part, 0);
        const said = new Set();
        for (const { pointer, cause, remedy, is_warning } of this.faults) {
            if (!this.root || said.has(pointer + cause)) continue;
            said.add(pointer + cause);
            const place = place_of(pointer, cause);
            const way = this.way_to(place);
            const part = way.at(-1)?.[0];
            if (part) say_fault(part, { cause, remedy, is_warning });
            const cell = this.cells.get(place);
            if (cell) say_fault(cell, place === pointer ? { cause, remedy, is_warning } : { cause: "missing" });
            for (const [each] of way) if (each.add_faults) counts.set(each, (counts.get(each) ?? 0) + 1);
        }
        for (const [part, count] of counts) part.add_faults(count);
        this.counted = counts;
    }

    /// Opens the path to a place and scrolls there; true: the form has it.
    reveal(pointer, { focus = false } = {}) {
        const fault = this.faults.find((each) => each.pointer === pointer);
        const place = fault ? place_of(pointer, fault.cause) : pointer;
        const way = this.way_to(place);
        if (way.length === 0) return false;
        this.enter(this.place(parts_of(place)));
        const cell = this.cells.get(place);
        if (cell?.control.isConnected) way.splice(0, way.length, [cell, ""]);
        way.forEach(([part], i) => part.open?.(way[i + 1]?.[1]));
        this.root.open_for(way[0][1]);
        const [part] = way.at(-1);
        (part.control ?? part.element).scrollIntoView({ block: "center" });
        if (focus) part.control?.focus({ preventScroll: true });
        return true;
    }
}

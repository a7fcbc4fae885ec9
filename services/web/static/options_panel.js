// Options of a generated scene (of a template, an imported section), each in its step. Text and drawing follow their changes.
import { by_id, set_text } from "./dom.js";
import { forget_faults, say_fault } from "./form.js";
import { Scalar } from "./form_fields.js";
import { Members } from "./form_groups.js";
import { parts_of, print } from "./json_text.js";
import { carried } from "./merge.js";

const pause = 250; // ms after the last key before the server is asked

/// Acts as a Form: the fields of Members write into `values`.
class Options {
    constructor(properties, changed) {
        Object.assign(this, { changed, properties, values: {}, is_own: true, shows_all: true });
        this.members = new Members(this, { properties }, []);
        this.members.make(this.values);
    }
    make(entry, parts, options) { return new Scalar(this, entry, parts, options); }
    names_for() { return null; }
    steps_of([name]) { return this.properties[name].topic ?? "section"; }
    set([name], value) {
        this.values[name] = value;
        this.update();
    }
    remove([name]) {
        delete this.values[name];
        this.update();
    }
    update() {
        this.members.update(this.values);
        this.changed();
    }
}

export class OptionsPanel {
    /// pane: receives the generated text; refuse(fault): for faults of no option; closed(): called when the options are hidden;
    /// shaped(study): removes parts that the question does not need.
    constructor(pane, refuse, closed, shaped) {
        Object.assign(this, { pane, refuse, closed, shaped, opened: 0, source: null });
    }

    /// source: {title, properties: schemas by name, base: the present text to replace, make(values, signal): {study, note}, follow(values,
    /// control_of): shows defaults that follow other options, failed(values): another way to show faults}; base, follow and failed are
    /// optional.
    open(source) {
        this.close();
        this.source = source;
        this.opened += 1;
        this.made = source.base ?? this.study();
        this.options = new Options(source.properties, () => this.changed());
        set_text(by_id("options-title"), source.title);
        by_id("options-fields").replaceChildren(this.options.members.element);
        by_id("options").hidden = false;
        return this.make();
    }
    close() {
        clearTimeout(this.timer);
        this.asked?.abort();
        this.source = null;
        by_id("options").hidden = true;
        set_text(by_id("options-note"), "");
        this.closed();
    }
    study() {
        try {
            return JSON.parse(this.pane.text);
        } catch {
            return undefined;
        }
    }

    changed() {
        clearTimeout(this.timer);
        this.source.follow?.(this.options.values, (name) => this.options.members.child(name).control);
        this.timer = setTimeout(() => this.make(), pause);
    }

    /// Keeps edits by hand.
    async make() {
        this.asked?.abort();
        this.asked = new AbortController();
        const { members, values } = this.options;
        try {
            const { study, note = "" } = await this.source.make(values, this.asked.signal);
            forget_faults(members.element);
            const made = this.shaped(study);
            const { value, lost } = carried(this.made, this.study(), made);
            this.made = made;
            this.pane.edit(() => print(value ?? made), `made ${this.opened}`);
            set_text(by_id("options-note"), [note, lost.length ? `made anew, what was entered there is lost (Undo brings it back): ${lost.join(", ")}` : ""].filter(Boolean).join("; "));
        } catch (fault) {
            if (fault.name === "AbortError") return;
            forget_faults(members.element);
            this.tell(fault, members);
        }
    }
    tell(fault, members) {
        const placed = (fault.faults ?? []).map((one) => [members.child(parts_of(one.pointer)[0] ?? one.pointer), one]);
        for (const [part, one] of placed) if (part) say_fault(part, one);
        const [first] = placed.find(([part]) => part) ?? [];
        if (this.source.failed) this.source.failed(fault);
        else if (!first) return this.refuse(fault);
        if (first && !first.element.contains(document.activeElement)) first.control.scrollIntoView({ block: "nearest" });
        set_text(by_id("options-note"), "No section can be made of these options; the study is unchanged.");
    }
}

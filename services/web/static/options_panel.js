// Options from which a scene is made (a template's, an imported section's), as fields in the place of the form. The text and its
// drawing follow them.
import { by_id, set_text } from "./dom.js";
import { forget_faults, say_fault } from "./form.js";
import { Scalar } from "./form_fields.js";
import { Members } from "./form_groups.js";
import { parts_of } from "./json_text.js";

const pause = 250; // ms after the last key before the server is asked

/// Stands where a Form would: the fields of Members write into `values`.
class Options {
    constructor(properties, changed) {
        Object.assign(this, { changed, values: {}, is_own: true, shows_all: true });
        this.members = new Members(this, { properties }, []);
        this.members.make(this.values);
    }
    make(entry, parts, options) { return new Scalar(this, entry, parts, options); }
    names_for() { return null; }
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
    /// pane: where the made text goes; refuse(fault): what is not about an option; closed(): the form is back.
    constructor(pane, refuse, closed) {
        Object.assign(this, { pane, refuse, closed, made: null, opened: 0 });
        by_id("options-make").addEventListener("click", () => this.make());
        by_id("options-done").addEventListener("click", () => {
            this.close();
            document.querySelector("#form input")?.focus();
        });
    }

    /// source: {title, properties: schemas by name, make(values, signal): {text, note}, follow(values, control_of): shows defaults that
    /// follow other options, failed(values): another way to show what is wrong}; the last two may be left out.
    open(source) {
        this.close();
        this.source = source;
        this.opened += 1;
        this.options = new Options(source.properties, () => this.changed());
        set_text(by_id("options-title"), source.title);
        by_id("options-fields").replaceChildren(this.options.members.element);
        this.show(true);
        by_id("options-title").focus();
        return this.make();
    }
    close() {
        clearTimeout(this.timer);
        this.asked?.abort();
        this.show(false);
        this.closed();
    }
    show(is_shown) {
        by_id("options").hidden = !is_shown;
        by_id("form").hidden = is_shown;
        by_id("options-make").hidden = true;
        set_text(by_id("options-note"), "");
    }

    /// What was changed by hand since is not overwritten before one asks for it.
    changed() {
        clearTimeout(this.timer);
        this.source.follow?.(this.options.values, (name) => this.options.members.child(name).control);
        const is_own = this.made === null || this.pane.text === this.made;
        by_id("options-make").hidden = is_own;
        if (is_own) this.timer = setTimeout(() => this.make(), pause);
        else set_text(by_id("options-note"), "The scene was changed since it was made; these options make it anew.");
    }

    async make() {
        this.asked?.abort();
        this.asked = new AbortController();
        const { members, values } = this.options;
        try {
            const { text, note = "" } = await this.source.make(values, this.asked.signal);
            forget_faults(members.element);
            by_id("options-make").hidden = true;
            this.made = text;
            this.pane.edit(() => text, `made ${this.opened}`);
            set_text(by_id("options-note"), note);
        } catch (fault) {
            if (fault.name === "AbortError") return;
            forget_faults(members.element);
            this.tell(fault, members);
        }
    }
    tell(fault, members) {
        const placed = (fault.faults ?? []).map((one) => [members.child(parts_of(one.pointer)[0]), one]);
        for (const [part, one] of placed) if (part) say_fault(part, one);
        const [first] = placed.find(([part]) => part) ?? [];
        if (this.source.failed) this.source.failed(fault);
        else if (!first) return this.refuse(fault);
        if (first && !first.element.contains(document.activeElement)) first.control.scrollIntoView({ block: "nearest" });
        set_text(by_id("options-note"), "These options make no scene; the text is as it was.");
    }
}

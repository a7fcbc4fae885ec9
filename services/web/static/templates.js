// A new scene from a template: its options as fields of a form; scene, study and drawing follow them.
import * as api from "./api.js";
import { by_id, element, set_text } from "./dom.js";
import { forget_faults, say_fault } from "./form.js";
import { Scalar } from "./form_fields.js";
import { Members } from "./form_groups.js";
import { parts_of, print } from "./json_text.js";
import { default_of } from "./schema.js";

const pause = 250; // ms after the last key before the server is asked

const entry_of = ({ type, unit, default: usual, minimum, maximum, help, rule }) => ({ type, unit, default: usual, minimum, maximum, description: rule ? `${help} (default: ${rule})` : help });

/// Stands where a Form would: the fields of Members write into `values`.
class Options {
    constructor(template, changed) {
        Object.assign(this, { template, changed, values: {}, is_own: true, shows_all: true });
        const named = { type: "string", description: "of scene and study: small letters, digits, - and _", default: template.name };
        this.members = new Members(this, { properties: { name: named, ...Object.fromEntries(template.options.map((each) => [each.name, entry_of(each)])) } }, []);
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
        for (const { name, follows, share, minimum, maximum, unit } of this.template.options.filter((each) => each.follows)) {
            const of = this.values[follows] ?? this.template.options.find((each) => each.name === follows)?.default;
            const usual = Number(Math.min(maximum, Math.max(minimum, share * of)).toPrecision(4));
            this.members.child(name).control.placeholder = default_of({ default: usual, unit });
        }
        this.changed();
    }
}

export class Templates {
    /// pane: where the made text goes; refuse(fault): what is not about an option.
    constructor(pane, refuse) {
        Object.assign(this, { pane, refuse, made: null });
        by_id("template-choice").addEventListener("change", (event) => this.choose(event.target.value));
        by_id("template-make").addEventListener("click", () => this.make());
        by_id("template-done").addEventListener("click", () => {
            this.close();
            document.querySelector("#form input")?.focus();
        });
    }

    async offer() {
        if (this.templates) return;
        this.templates = await api.list_templates();
        by_id("template-choice").append(...this.templates.map(({ name, title }) => element("option", { value: name, title }, name.replaceAll("_", " "))));
        by_id("templates-row").hidden = this.templates.length === 0;
    }

    choose(name) {
        const template = this.templates.find((each) => each.name === name);
        if (!template) return this.close();
        this.options = new Options(template, () => this.changed());
        set_text(by_id("template-title"), `${template.title}.`);
        by_id("template-options").replaceChildren(this.options.members.element);
        this.show(true);
        by_id("template-title").focus();
        this.make();
    }
    close() {
        clearTimeout(this.timer);
        this.asked?.abort();
        by_id("template-choice").value = "";
        this.show(false);
    }
    show(is_shown) {
        by_id("template").hidden = !is_shown;
        by_id("form").hidden = is_shown;
        by_id("template-make").hidden = true;
    }

    /// What was changed by hand since is not overwritten before one asks for it.
    changed() {
        clearTimeout(this.timer);
        const is_own = this.pane.text === this.made;
        by_id("template-make").hidden = is_own;
        set_text(by_id("template-note"), is_own ? "" : "The scene was changed since it was made; these options make it anew.");
        if (is_own) this.timer = setTimeout(() => this.make(), pause);
    }

    async make() {
        this.asked?.abort();
        this.asked = new AbortController();
        const { template, values, members } = this.options;
        try {
            const { study } = await api.make_from_template(template.name, values, this.asked.signal);
            forget_faults(members.element);
            set_text(by_id("template-note"), "");
            by_id("template-make").hidden = true;
            this.made = print(study);
            this.pane.edit(() => this.made, `template ${template.name}`);
        } catch (fault) {
            if (fault.name === "AbortError") return;
            forget_faults(members.element);
            this.tell(fault, members);
        }
    }
    tell(fault, members) {
        const faults = fault.faults ?? [];
        const placed = faults.map((one) => [members.child(parts_of(one.pointer)[0]), one]);
        for (const [part, one] of placed) if (part) say_fault(part, one);
        const [first] = placed.find(([part]) => part) ?? [];
        if (!first) return this.refuse(fault);
        if (!first.element.contains(document.activeElement)) first.control.scrollIntoView({ block: "nearest" });
        set_text(by_id("template-note"), "These options make no scene; what stands there is the last one that they made.");
    }
}

// The editor of the JSON text: line numbers, marks at faulty lines, and undo for changes by the form.
import { by_id, element } from "./dom.js";
import { find_pointer } from "./json_text.js";

const most_steps = 200;

export class JsonPane {
    /// changed(text): called after every change; it calls mark().
    constructor(changed) {
        Object.assign(this, { box: by_id("study"), gutter: by_id("study-lines"), undo: by_id("form-undo"), changed, past: [], kind: null, faults: [] });
        this.box.addEventListener("input", () => this.tell());
        this.box.addEventListener("scroll", () => this.follow());
        this.undo.addEventListener("click", () => this.step_back());
    }
    get text() { return this.box.value; }

    tell() {
        this.kind = null;
        this.changed(this.text);
    }

    /// Replaces the whole text.
    take(text) {
        if (this.text.trim() !== "" && this.text !== text) this.remember();
        this.box.value = text;
        this.box.scrollTop = 0;
        this.tell();
    }

    /// A change by the form. Consecutive changes of one kind (typing in a field) are one undo step.
    edit(change, kind = null) {
        const text = change(this.text);
        if (text === this.text) return;
        if (kind === null || kind !== this.kind) this.remember();
        const { scrollTop } = this.box;
        this.box.value = text;
        this.box.scrollTop = scrollTop;
        this.tell();
        this.kind = kind;
    }
    remember() {
        this.past = [...this.past, this.text].slice(-most_steps);
        this.undo.disabled = false;
    }
    step_back() {
        this.box.value = this.past.pop();
        this.undo.disabled = this.past.length === 0;
        this.tell();
    }

    line_of(pointer) {
        return this.text.slice(0, find_pointer(this.text, pointer).start).split("\n").length;
    }
    /// faults: {pointer, cause} whose lines to mark.
    mark(faults) {
        this.faults = faults;
        this.draw_lines();
    }
    draw_lines() {
        const causes = new Map();
        for (const { pointer, cause } of this.faults) {
            const line = this.line_of(pointer);
            causes.set(line, [causes.get(line), cause].filter(Boolean).join("; "));
        }
        const count = this.text.split("\n").length;
        const lines = [];
        let plain = [];
        for (let line = 1; line <= count; line += 1) {
            if (!causes.has(line)) plain.push(line);
            else {
                lines.push(`${plain.join("\n")}${plain.length ? "\n" : ""}`, element("mark", { title: causes.get(line) }, String(line)), line < count ? "\n" : "");
                plain = [];
            }
        }
        this.gutter.replaceChildren(...lines, plain.join("\n"));
        this.follow();
    }
    follow() {
        this.gutter.scrollTop = this.box.scrollTop;
    }

    scroll_to(pointer) {
        this.box.scrollTop = (this.line_of(pointer) - 4) * parseFloat(getComputedStyle(this.box).lineHeight);
    }
    select(pointer) {
        const place = find_pointer(this.text, pointer);
        this.box.focus();
        this.box.setSelectionRange(place.start, place.end);
        this.scroll_to(pointer);
    }
}

// A field for a motion, a mesh or another file. Uploads chosen or dropped files and puts the returned reference into the scene. A path on
// the service's machine can be typed.
import * as api from "./api.js";
import { element, set_text } from "./dom.js";
import { field_of, new_id } from "./form_fields.js";

/// Entries whose help mentions references to uploaded files.
export const is_file = (entry) => entry.type === "string" && /file:sha256\//.test(entry.description ?? "");

export class FileField {
    constructor(form, entry, parts, { name, required = false }) {
        Object.assign(this, { form, entry, parts, name, required });
        const id = new_id();
        this.control = element("input", { id, type: "text", class: "word", autocomplete: "off", spellcheck: "false", placeholder: "path, or send a file", list: `${id}-sent`,
            onfocus: () => this.offer(), onchange: () => this.take(this.control.value.trim()) });
        this.sent = element("datalist", { id: `${id}-sent` });
        this.chooser = element("input", { type: "file", id: `${id}-file`, class: "unseen", onchange: () => this.send(this.chooser.files[0]) });
        this.state = element("p", { class: "file-state", role: "status" });
        this.refused = element("div", { class: "file-faults", role: "alert" }); // separate from the document's faults, which change with the text
        const drop = element("div", { class: "drop", ondragover: (event) => this.over(event), ondragleave: () => drop.classList.remove("over"), ondrop: (event) => this.drop(event) },
            element("label", { for: this.chooser.id, class: "button" }, "Send a file…"), this.chooser, element("span", { class: "muted" }, "or drop it here"));
        this.drop_place = drop;
        this.element = field_of(this, id, [this.control, this.sent, drop, this.state, this.refused]);
    }
    child() { return null; }

    take(text) {
        if (text === "") this.form.remove(this.parts);
        else this.form.set(this.parts, text);
    }
    over(event) {
        event.preventDefault();
        this.drop_place.classList.add("over");
    }
    drop(event) {
        event.preventDefault();
        event.stopPropagation();
        this.drop_place.classList.remove("over");
        this.send(event.dataTransfer.files[0]);
    }

    async send(file) {
        if (!file) return;
        this.chooser.value = "";
        this.refuse(null);
        const before = this.state.textContent;
        set_text(this.state, `Sending ${file.name}…`);
        try {
            const answer = await api.send_file(file);
            this.wanted_kind(answer);
            this.form.set(this.parts, answer.reference);
            this.tell(answer);
            if (answer.warnings?.length) this.refuse({ faults: answer.warnings.map(({ message }) => ({ cause: message })) }, file.name);
        } catch (fault) {
            set_text(this.state, before);
            this.refuse(fault, file.name);
        }
    }
    wanted_kind({ kind, name }) {
        const wanted = this.name === "msh_file" ? "mesh" : "motion";
        if (kind !== wanted) throw new Error(`${name} is a ${kind}, a ${wanted} belongs here`);
    }
    tell({ name, about, reference }) {
        this.known = reference;
        set_text(this.state, `${name}: ${about}`);
    }
    /// Faults of the file only: the scene is unchanged.
    refuse(fault, name) {
        const faults = fault?.faults?.length ? fault.faults : fault ? [{ cause: fault.message }] : [];
        this.refused.replaceChildren(...faults.map(({ cause, remedy, pointer }) => element("p", {}, element("strong", {}, `${name}: ${pointer ? `${pointer}: ` : ""}${cause}`), remedy ? ` ${remedy}` : "")));
    }

    async offer() {
        const files = await api.list_files().catch(() => []);
        const kind = this.name === "msh_file" ? "mesh" : "motion";
        this.sent.replaceChildren(...files.filter((file) => file.kind === kind).map((file) => element("option", { value: file.reference }, `${file.name}: ${file.about}`)));
    }

    update(value) {
        if (document.activeElement !== this.control || !this.form.is_own) this.control.value = value ?? "";
        if (value === this.known) return;
        this.known = value;
        set_text(this.state, "");
        if (String(value).startsWith("file:sha256/")) this.find(value);
    }
    async find(reference) {
        const files = await api.list_files().catch(() => null);
        const file = files?.find((each) => each.reference === reference);
        if (this.known !== reference || !files) return;
        if (file) this.tell(file);
        else set_text(this.state, "this service has no such file: send it");
    }
}

// The dialog that submits a study: filled in the form or as JSON beside it, chosen as a file, or one of the shipped
// examples. Every fault that the server finds is shown at its field and its line, and listed.
import * as api from "./api.js";
import { by_id, element, set_text } from "./dom.js";
import { Form } from "./form.js";
import { JsonPane } from "./json_pane.js";
import { print } from "./json_text.js";
import { LiveDrawing } from "./live_drawing.js";
import { OptionsPanel } from "./options_panel.js";
import { SectionImport } from "./section_import.js";
import { Templates } from "./templates.js";

export class SubmitDialog {
    /// submitted(run): the server took it.
    constructor(submitted) {
        this.submitted = submitted;
        this.dialog = by_id("submit-dialog");
        this.pane = new JsonPane((text) => this.changed(text));
        this.form = new Form((change, kind) => this.pane.edit(change, kind), (pointer) => this.pane.scroll_to(pointer));
        this.drawing = new LiveDrawing((fault) => this.fault_item(fault), (pointer) => this.point_to(pointer),
                                       (faults) => this.mark("drawing", faults));
        this.options = new OptionsPanel(this.pane, (fault) => this.refuse(fault), () => {
            by_id("template-choice").value = "";
            this.drawing.return_to(this.pane.text);
        });
        this.templates = new Templates(this.options);
        this.sections = new SectionImport(this.options, this.pane, this.drawing);
        this.dialog.addEventListener("dragover", (event) => event.preventDefault());
        this.dialog.addEventListener("drop", (event) => this.drop(event));
        for (const button of document.querySelectorAll("[data-opens=submit]")) {
            button.addEventListener("click", () => this.open());
        }
        by_id("examples").addEventListener("change", (event) => this.take_example(this.examples.find(({ name }) => name === event.target.value)));
        by_id("study-file").addEventListener("change", (event) => this.take_file(event.target));
        by_id("submit").addEventListener("click", () => this.submit());
        by_id("show-plan").addEventListener("click", () => this.show_plan());
        by_id("submit-close").addEventListener("click", () => this.dialog.close());
        this.dialog.addEventListener("keydown", (event) => {
            if (event.key === "Enter" && event.ctrlKey) this.submit();
        });
    }

    async open() {
        this.dialog.showModal();
        this.clear();
        try {
            await this.form.start();
            this.form.show(this.pane.text);
            if (this.has_examples) return;
            await this.templates.offer();
            const examples = this.examples = await api.list_examples();
            by_id("examples").append(...examples.map(({ name, title }) => element("option", { value: name, title: title || null }, name)));
            by_id("examples-row").hidden = examples.length === 0;
            this.has_examples = true;
        } catch (fault) {
            this.refuse(fault);
        }
    }

    /// A study that was run, to be changed and run again: without the variants that the service made of it.
    async edit({ variants = [], ...study }) {
        await this.open();
        this.take_text(print({ ...study, variants: variants.filter(({ made_by: by }) => !by) }));
    }

    take_text(text) {
        this.clear();
        this.options.close();
        this.pane.take(text);
    }

    /// By whom and whatever.
    changed(text) {
        this.form.show(text);
        this.pane.mark(this.form.faults);
        this.show_mended();
        this.drawing.changed(text);
        by_id("study").removeAttribute("aria-invalid");
    }

    /// Of what was refused.
    show_mended() {
        const left = new Set(this.form.faults.map(({ pointer, cause }) => pointer + cause));
        const items = [...by_id("fault-list").children];
        for (const item of items) item.classList.toggle("mended", !left.has(item.dataset.fault));
        if (items.length > 0 && items.every((item) => item.matches(".mended"))) by_id("faults").hidden = true;
    }

    mark(source, faults) {
        this.form.take_faults(source, faults);
        this.pane.mark(this.form.faults);
    }

    async take_file(input) {
        const file = input.files[0];
        if (file) this.take_text(await file.text());
        input.value = "";
    }

    /// A study, or a section drawn elsewhere; a motion is dropped on its field.
    async drop(event) {
        event.preventDefault();
        const file = event.dataTransfer.files[0];
        if (!file) return;
        if (/\.(dxf|csv)$/i.test(file.name)) this.sections.begin(file.name, await file.text());
        else this.take_text(await file.text());
    }

    async take_example(example) {
        if (!example) return;
        by_id("examples").value = ""; // to be chosen again
        try {
            const study = example.study ?? await api.read_example(example.name);
            this.take_text(print(study));
        } catch (fault) {
            this.refuse(fault);
        }
    }

    async submit() {
        this.clear();
        by_id("submit").disabled = true;
        try {
            const run = await api.submit_study(by_id("study").value);
            this.dialog.close();
            this.submitted(run);
        } catch (fault) {
            this.refuse(fault);
        } finally {
            by_id("submit").disabled = false;
        }
    }

    async show_plan() {
        this.clear();
        try {
            const scene = JSON.parse(by_id("study").value).scene;
            const plans = await api.plan_scene(JSON.stringify(scene ?? null));
            by_id("plan").replaceChildren(...Object.entries(plans).flatMap(([phase, text]) =>
                [element("h3", {}, phase), this.plan_table(phase, text)]));
            by_id("plan").hidden = false;
            by_id("plan").scrollIntoView({ block: "nearest" });
            by_id("plan").focus({ preventScroll: true });
        } catch (fault) {
            for (const one of fault.faults ?? []) one.pointer = `/scene${one.pointer}`; // what was sent is a part of the study
            this.refuse(fault);
        }
    }

    /// A plan's lines are columns of text: on or left out, what, why, and the place in the scene that decided.
    plan_table(phase, text) {
        const rows = text.split("\n").filter((line) => line.trim() !== "").map((line) => {
            const [state, what = "", why = "", place = ""] = line.trim().split(/\s{2,}/);
            const pointer = (place || why).match(/^\(?(\/[^)\s]*)\)?$/)?.[1];
            return element("tr", { class: state === "on" ? null : "waiting" },
                element("td", {}, element("span", { class: `state ${state === "on" ? "good" : "off"}` }, state === "on" ? "✓ on" : `⊘ ${state}`)),
                element("th", { scope: "row" }, what), element("td", {}, place || !pointer ? why : ""),
                element("td", {}, pointer ? this.link_to(`/scene${pointer}`, pointer) : place));
        });
        return element("table", { "aria-label": `plan of ${phase}` }, element("tbody", {}, ...rows));
    }

    link_to(pointer, text) {
        return element("button", { type: "button", class: "link", title: "Show the place in the study",
                                   onclick: () => this.point_to(pointer) }, element("code", {}, text));
    }

    clear() {
        by_id("faults").hidden = true;
        by_id("plan").hidden = true;
        by_id("fault-list").replaceChildren();
        by_id("study").removeAttribute("aria-invalid");
        this.mark("submission", []);
    }

    refuse(fault) {
        const faults = fault.faults ?? [];
        const count = faults.length === 1 ? "1 fault" : `${faults.length} faults`;
        set_text(by_id("fault-title"), faults.length && !/\d fault/.test(fault.message) ? `${fault.message} (${count})` : fault.message);
        by_id("fault-list").replaceChildren(...faults.map((one) => this.fault_item(one)));
        by_id("faults").hidden = false;
        by_id("study").setAttribute("aria-invalid", "true");
        this.mark("submission", faults);
        if (faults.length) {
            this.options.close();
            this.pane.scroll_to(faults[0].pointer);
        }
        if (!faults.length || !this.form.reveal(faults[0].pointer, { focus: true })) by_id("fault-title").focus();
    }

    fault_item(one, is_in_text = true) {
        const is_place = is_in_text && (one.pointer === "" || one.pointer.startsWith("/"));
        return element("li", { "data-fault": one.pointer + one.cause },
                       is_place ? this.link_to(one.pointer, one.pointer || "/") : element("code", {}, one.pointer), ` ${one.cause} `,
                       is_place ? element("span", { class: "muted" }, `line ${this.pane.line_of(one.pointer)}`) : null,
                       one.remedy ? element("span", { class: "remedy" }, one.remedy) : null);
    }

    /// Selects the text that the pointer names, and opens its field.
    point_to(pointer) {
        this.options.close();
        this.form.reveal(pointer);
        this.pane.select(pointer);
    }
}

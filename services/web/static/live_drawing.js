// Draws the section of the editor's text by the server during typing. On failure the last drawing stays, paler, with the reason.
import * as api from "./api.js";
import { by_id, set_text } from "./dom.js";

const pause = 300; // [ms] pause in typing before a request

export class LiveDrawing {
    /// fault_item(fault, is_in_text): a list item with a link to the fault's place; point_to(pointer): goes there; found(faults): called
    /// with the drawing's faults.
    constructor(fault_item, point_to, found) {
        Object.assign(this, { fault_item, found });
        by_id("drawing-picture").addEventListener("click", (event) => {
            const mark = event.target.closest("[data-pointer]");
            if (mark) point_to(mark.dataset.pointer);
        });
        by_id("drawing-mesh").addEventListener("change", () => this.changed(by_id("study").value));
    }

    /// Replaces the drawing of show_foreign.
    return_to(text) {
        if (this.is_foreign) this.changed(text);
    }

    changed(text) {
        this.is_foreign = false;
        clearTimeout(this.timer);
        this.asked?.abort();
        if (text.trim() === "") return this.forget();
        this.timer = setTimeout(() => this.draw(text), pause);
    }

    forget() {
        by_id("drawing-picture").replaceChildren();
        this.show_warnings([]);
        this.tell("", []);
        by_id("drawing").hidden = true;
    }

    async draw(text) {
        try {
            JSON.parse(text);
        } catch (fault) {
            return this.keep(`This is not JSON yet: ${fault.message}`, []);
        }
        const { signal } = this.asked = new AbortController();
        try {
            this.show(await api.draw_document(text, by_id("drawing-mesh").checked, signal));
        } catch (fault) {
            if (!signal.aborted) this.keep(fault.message, fault.faults ?? []);
        }
    }

    show(text) {
        const faults = this.place(text);
        if (!faults) return;
        const number = faults.filter(({ is_warning }) => !is_warning).length;
        this.tell(number === 0 ? "" : `${number === 1 ? "1 fault, marked" : `${number} faults, marked`} in red where it has a place`, faults);
    }

    /// Shows the faults of an imported file: its picture (SVG, or null), and the reported faults.
    show_foreign(text, fault) {
        clearTimeout(this.timer);
        this.asked?.abort();
        this.is_foreign = true;
        if (text) this.place(text);
        this.tell(fault.message, fault.faults ?? [], "elsewhere");
    }

    /// The faults marked in the drawing; null: no picture.
    place(text) {
        const drawn = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
        if (drawn.localName !== "svg") return this.keep("The server's drawing cannot be read", []), null;
        const title = drawn.querySelector("title")?.textContent ?? "";
        drawn.setAttribute("role", "img");
        drawn.setAttribute("aria-label", `Section: ${title}`);
        for (const size of ["width", "height"]) drawn.removeAttribute(size); // fill the available width
        by_id("drawing-picture").replaceChildren(document.importNode(drawn, true));
        const faults = [...drawn.querySelectorAll("[data-cause]")].map(({ dataset }) => (
            { pointer: dataset.pointer, cause: dataset.cause, remedy: dataset.remedy }));
        by_id("drawing-picture").classList.remove("stale");
        const warnings = [...drawn.querySelectorAll("[data-warning]")].map(({ dataset }) => ({ pointer: dataset.pointer, cause: dataset.warning, remedy: "", is_warning: true }));
        this.show_warnings(warnings);
        return [...faults, ...warnings];
    }

    show_warnings(warnings) {
        by_id("drawing-warnings-title").hidden = warnings.length === 0;
        by_id("drawing-warnings").replaceChildren(...warnings.map((one) => this.fault_item(one)));
    }

    keep(why, faults) {
        const something = by_id("drawing-picture").firstElementChild !== null;
        by_id("drawing-picture").classList.add("stale");
        this.tell(something ? `${why}. This is the last drawing that was possible.` : why, faults);
    }

    /// about: whether the faults belong to the "document" or are "elsewhere".
    tell(note, faults, about = "document") {
        set_text(by_id("drawing-note"), note);
        this.found(about === "document" ? faults : []);
        by_id("drawing-faults").replaceChildren(...faults.filter(({ is_warning }) => !is_warning).map((one) => this.fault_item(one, about === "document")));
        by_id("drawing").hidden = false;
    }
}

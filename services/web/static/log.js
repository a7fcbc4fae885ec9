// The end of the log of one attempt, updated while it grows.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";

const kept_characters = 200000;

export class LogView {
    constructor() {
        this.key = null;
        by_id("log-attempt").addEventListener("change", () => this.switch_attempt());
    }

    close() {
        this.key = null;
        this.task = null;
    }

    async show(task) {
        const other = this.task?.id !== task.id;
        const newer = !other && this.task.attempts.length !== task.attempts.length;
        this.task = task;
        const select = by_id("log-attempt");
        mirror(select, task.attempts, (attempt) => attempt.number,
               (attempt) => element("option", { value: attempt.number }, `attempt ${attempt.number}`), () => {});
        if ((other || newer) && task.attempts.length > 0) select.value = String(task.attempts.at(-1).number);
        by_id("log-message").hidden = task.attempts.length > 0;
        by_id("log").hidden = task.attempts.length === 0;
        if (task.attempts.length > 0) await this.extend();
    }

    async switch_attempt() {
        if (this.task) await this.extend();
    }

    /// Appends new text, and keeps the end in view if it was.
    async extend() {
        const attempt = by_id("log-attempt").value;
        const key = `${this.task.id}/${attempt}`;
        const box = by_id("log");
        if (this.key !== key) {
            this.key = key;
            this.offset = 0;
            box.textContent = "";
        }
        const from = this.offset;
        const { text, next } = await api.read_log(this.task.id, attempt, from);
        if (this.key !== key || this.offset !== from) return;
        this.offset = next;
        if (text === "") return;
        const at_end = box.scrollHeight - box.scrollTop - box.clientHeight < 30;
        set_text(box, (box.textContent + text).slice(-kept_characters));
        if (at_end) box.scrollTop = box.scrollHeight;
    }
}

// The dialog for a run's title.
import * as api from "./api.js";
import { by_id, set_text } from "./dom.js";

export class RenameDialog {
    /// renamed(): called after the title changed.
    constructor(renamed) {
        this.dialog = by_id("rename-dialog");
        by_id("rename-keep").addEventListener("click", () => this.dialog.close());
        this.dialog.querySelector("form").addEventListener("submit", async (event) => {
            event.preventDefault(); // closed when the server accepted it
            try {
                await api.rename_run(this.run.id, by_id("rename-text").value.trim());
                this.dialog.close();
                renamed();
            } catch (fault) {
                set_text(by_id("rename-fault"), `The server refused: ${fault.message}`);
                by_id("rename-fault").hidden = false;
            }
        });
    }

    open(run) {
        this.run = run;
        by_id("rename-text").value = run.title || run.name;
        by_id("rename-fault").hidden = true;
        this.dialog.showModal();
        by_id("rename-text").select();
    }
}

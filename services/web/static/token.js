// The service's bearer token: requested when the service needs one, stored for this tab only. Links cannot send it, so the page fetches
// linked files.
import * as api from "./api.js";
import { by_id, set_text } from "./dom.js";

const kept_as = "breachline-token";

export class TokenDialog {
    constructor() {
        this.dialog = by_id("token-dialog");
        this.asking = null;
        this.dialog.addEventListener("cancel", (event) => event.preventDefault()); // nothing works without a token
        this.dialog.addEventListener("close", () => this.take(by_id("token").value.trim()));
        document.addEventListener("click", (event) => this.hand_over(event));
        api.authorise(sessionStorage.getItem(kept_as), (refused) => this.ask(refused));
    }

    /// Resolves to the token that the user enters; many refused requests open one dialog.
    ask(refused) {
        this.asking ??= new Promise((resume) => {
            this.resume = resume;
            set_text(by_id("token-message"), refused ? "The service refused this token." : "");
            by_id("token").value = "";
            this.dialog.showModal();
        });
        return this.asking;
    }

    take(token) {
        sessionStorage.setItem(kept_as, token);
        this.asking = null;
        this.resume(token);
    }

    async hand_over(event) {
        const link = event.target.closest?.("a[download][href^='/v1/']");
        if (!link || !sessionStorage.getItem(kept_as)) return;
        event.preventDefault();
        const copy = document.createElement("a");
        copy.href = URL.createObjectURL(await api.read_file(link.getAttribute("href")));
        copy.download = link.download || link.getAttribute("href").split("/").at(-1).split("?")[0];
        copy.click();
        setTimeout(() => URL.revokeObjectURL(copy.href), 60000);
    }
}

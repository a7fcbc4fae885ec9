// The glossary of the dashboard, and links to its terms.
import { read_glossary } from "./api.js";
import { by_id, element } from "./dom.js";

const terms = read_glossary().catch(() => ({}));
const address = (anchor) => `#/glossary/${anchor}`;

/// A word with a link to its term, and the meaning as a tooltip.
export function term(anchor, text) {
    const link = element("a", { class: "term", href: address(anchor) }, text);
    terms.then((known) => { link.title = known[anchor]?.means ?? ""; });
    return link;
}
terms.then((known) => {
    for (const link of document.querySelectorAll("a.term")) link.title = known[link.hash.slice(address("").length)]?.means ?? "";
});

const with_code = (text) => text.split("`").map((piece, i) => (i % 2 ? element("code", {}, piece) : piece));

export async function show_glossary(anchor) {
    const list = by_id("glossary-terms");
    const known = await terms;
    if (!list.firstElementChild) {
        list.append(...Object.entries(known).map(([name, { term: word, means }]) =>
            element("div", { id: `term-${name}` }, element("dt", {}, element("a", { href: address(name) }, word)), element("dd", {}, ...with_code(means)))));
    }
    for (const entry of list.children) entry.classList.toggle("chosen", entry.id === `term-${anchor}`);
    by_id(`term-${anchor}`)?.scrollIntoView({ block: "center" });
}

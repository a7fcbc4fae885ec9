// The form of a new run as a reader of the page finds his way in it.

/// Clicks the line of one that is closed; looked at and clicked at once, as the page opens some itself.
const open = (fold) => fold.evaluate((each) => each.open || each.querySelector(":scope > summary").click());

/// Opens groups and rows by their lines, where they are closed: ["scene", "fem", "stages", "0"].
export async function open_groups(page, way) {
    let root = page.locator("#form");
    for (const name of way) {
        const row = /^\d+$/.test(name) ? root.locator(".rows > li").nth(Number(name)).locator("> details") : root.locator(`details[data-group="${name}"]`).first();
        const fold = (await row.count()) ? row : root.locator(`.rows > li > details:has(> summary .fold-title:text-matches("^${name}( |$)"))`).first();
        if (!(await fold.count())) continue; // a choice has no line of its own
        const hidden = root.locator("details.more-members:not([open])").filter({ has: fold });
        if (await hidden.count()) await open(hidden.first());
        await open(fold);
        await page.evaluate(() => new Promise((filled) => requestAnimationFrame(() => setTimeout(filled)))); // when it has opened
        root = fold;
    }
    if (way.length) await show_step_of(page, root);
}

const titles = { section: "Section", soils: "Soils", water: "Water", question: "Question", check: "Check" };
/// The first step that shows a part of the form.
async function show_step_of(page, part) {
    const steps = await part.evaluate((each) => each.closest("[data-steps]")?.dataset.steps);
    if (steps) await go_to_step(page, titles[steps.split(" ")[0]]);
}

/// The study's text, which is shown for it.
export async function write_json(page, text) {
    if (await page.isHidden("#json")) await page.click("#json-show");
    await page.fill("#study", text);
}
export const go_to_step = (page, name) => page.locator("#steps button", { hasText: name }).click();

/// The control of a place, its step shown and its groups opened.
export async function field_of(page, pointer) {
    await open_groups(page, pointer.split("/").slice(1, -1));
    const label = page.locator(`#form label[title="${pointer}"]`).first();
    await label.waitFor({ state: "attached" }); // a group is filled when it has opened
    await show_step_of(page, label);
    const more = page.locator("#form details.more-members").filter({ has: page.locator(`label[title="${pointer}"]`) });
    for (let i = 0; i < (await more.count()); i += 1) await open(more.nth(i));
    return page.locator(`#${await label.getAttribute("for")}`);
}

// The form of a new run as a reader of the page finds his way in it.

/// The control of a place, its groups opened by a reader's clicks; null where the place has no field of its own.
export async function field_of(page, pointer) {
    const way = pointer.split("/").slice(1, -1);
    let root = page.locator("#form");
    for (const [i, name] of way.entries()) {
        const row = /^\d+$/.test(name) ? root.locator(".rows > li").nth(Number(name)).locator("> details") : root.locator(`details[data-group="${name}"]`).first();
        const fold = (await row.count()) ? row : root.locator(`.rows > li > details:has(> summary .fold-title:text-matches("^${name}( |$)"))`).first();
        if (!(await fold.count())) continue; // a choice has no line of its own
        const hidden = root.locator("details.more-members:not([open])").filter({ has: fold });
        if (await hidden.count()) await hidden.first().locator("> summary").click();
        if (!(await fold.evaluate((each) => each.open))) await fold.locator("> summary").click();
        root = fold;
    }
    const label = page.locator(`#form label[title="${pointer}"]`).first();
    if (!(await label.count())) return null;
    const more = page.locator("#form details.more-members").filter({ has: page.locator(`label[title="${pointer}"]`) });
    for (let i = 0; i < (await more.count()); i += 1) if (!(await more.nth(i).evaluate((each) => each.open))) await more.nth(i).locator("> summary").click();
    return page.locator(`#${await label.getAttribute("for")}`);
}

// A service that wants a bearer token: the page asks for it, refuses a wrong one, keeps the right one for the tab, and
// hands over files that a link alone could not fetch.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { screenshot, until } from "./browser.mjs";
import { live_page, program } from "./service.mjs";

const token = "an-unlikely-token-of-the-test";
const study = fileURLToPath(new URL("small_study.json", import.meta.url));
let token_file;
let service;
let page;

const live = live_page("token-", {
    options: (folder) => {
        token_file = path.join(folder, "token");
        writeFileSync(token_file, `${token}\n`);
        return ["--token-file", token_file];
    },
    ready: (opened) => {
        ({ service, page } = opened);
        execFileSync(program("breach"), ["--server", service.url, "--token-file", token_file, "submit", study]);
    },
});

const runs = () => page.locator("#run-list li").count();

async function give(text) {
    await page.waitForSelector("#token-dialog[open]");
    await page.fill("#token", text);
    await page.keyboard.press("Enter");
}

test("nothing is shown before the token, and a wrong one is refused", async () => {
    await page.goto(service.url);
    await page.waitForSelector("#token-dialog[open]");
    await page.keyboard.press("Escape");
    assert.ok(await page.locator("#token-dialog[open]").count(), "there is nothing else to see");
    await give("not-the-right-one-at-all");
    await until("the refusal", async () => /refused/.test(await page.textContent("#token-message")));
    assert.equal(await runs(), 0);
    await screenshot(page, "token");
});

test("the right token opens the page, for this tab and after a reload", async () => {
    await give(token);
    await until("the run", async () => (await runs()) === 1);
    await page.reload();
    await until("the run again", async () => (await runs()) === 1);
    assert.equal(await page.locator("#token-dialog[open]").count(), 0);
    assert.ok(!(await page.content()).includes(token));
});

test("a file that a link alone could not fetch is handed over", async () => {
    await page.click("#run-list a");
    await until("the end of the run", async () => /succeeded|questionable|partial|failed/.test(await page.textContent("#run-state")), 120000);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#runout-csv")]);
    assert.match(readFileSync(await download.path(), "utf8"), /^transfer_time,state,runout/);
    assert.deepEqual(live.browser.complaints, []);
});

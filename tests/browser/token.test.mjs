// A service that wants a bearer token: the page asks for it, refuses a wrong one, keeps the right one for the tab, and
// hands over files that a link alone could not fetch.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { build_folder, open_browser, screenshot, until } from "./browser.mjs";
import { program, start_service } from "./service.mjs";

const token = "an-unlikely-token-of-the-test";
const study = fileURLToPath(new URL("small_study.json", import.meta.url));
let folder;
let service;
let browser;
let page;

before(async () => {
    folder = mkdtempSync(path.join(build_folder, "token-"));
    const file = path.join(folder, "token");
    writeFileSync(file, `${token}\n`);
    service = await start_service(path.join(folder, "data"), "--token-file", file);
    execFileSync(program("breach"), ["--server", service.url, "--token-file", file, "submit", study]);
    browser = await open_browser();
    page = browser.page;
});

after(async () => {
    await browser?.close();
    await service?.stop();
    rmSync(folder, { recursive: true, force: true });
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
    await until("the end of the run", async () => /succeeded|partial|failed/.test(await page.textContent("#run-state")), 120000);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#runout-csv")]);
    assert.match(readFileSync(await download.path(), "utf8"), /^transfer_time,state,runout/);
    assert.deepEqual(browser.complaints, []);
});

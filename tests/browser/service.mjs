// The real orchestrator for a test, with a page of it in a real browser. Environment: BREACH_BIN (the built programs).
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import path from "node:path";
import { after, before } from "node:test";
import { createInterface } from "node:readline";
import { build_folder, open_browser } from "./browser.mjs";

export function program(name) {
    const file = path.join(process.env.BREACH_BIN, name);
    assert.ok(existsSync(file), `${file} is built`);
    return file;
}

/// Starts the service on a free port, its data in `folder`; its first line says where it listens. {url, stop()}.
export async function start_service(folder, ...options) {
    const service = spawn(program("breachline"), ["serve", "--data", folder, "--port", "0", ...options],
                          { stdio: ["ignore", "pipe", "inherit"] });
    const lines = createInterface({ input: service.stdout });
    const first = await Promise.race([
        new Promise((resume) => lines.once("line", resume)),
        new Promise((_, give_up) => service.once("exit", (code) => give_up(new Error(`the service ended: ${code}`)))),
    ]);
    const stop = () => {
        if (service.exitCode !== null) return null;
        const ended = new Promise((resume) => service.once("exit", resume));
        service.kill("SIGTERM");
        return ended;
    };
    return { url: JSON.parse(first).url.replace(/\/$/, ""), stop };
}

/// For all tests of a file: a service with a folder of its own below the build's and a page, opened before the first test and
/// cleared away after the last. `options(folder)`: further options of the service; `ready(live)`: called when all of it is there (a
/// second `before` of the file may run before the first has ended). {folder, service, browser, page}, filled by then.
export function live_page(prefix, { options = () => [], ready = () => {} } = {}) {
    const live = {};
    before(async () => {
        live.folder = mkdtempSync(path.join(build_folder, prefix));
        live.service = await start_service(path.join(live.folder, "data"), ...options(live.folder));
        live.browser = await open_browser();
        live.page = live.browser.page;
        ready(live);
    });
    after(async () => {
        await live.browser?.close();
        await live.service?.stop();
        rmSync(live.folder, { recursive: true, force: true });
    });
    return live;
}

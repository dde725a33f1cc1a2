// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Opens pages from files in a headless Chromium whose WebGL is drawn by the processor.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { compose } from './compose.mjs';

const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';
const kSoftware = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-sandbox'];
const kWithout = ['--disable-gpu', '--disable-3d-apis', '--no-sandbox'];

export async function startBrowser({ webgl = true } = {}) {
  const browser = await chromium.launch({ executablePath, args: webgl ? kSoftware : kWithout });
  const folder = mkdtempSync(join(tmpdir(), 'impinge-page-'));
  const shared = [];
  let count = 0;

  /** Opens the page; `check` at the end fails on any error on the page and on any request but for the page itself. */
  async function open(
    html,
    { width = 1024, height = 640, scheme = 'light', motion = 'reduce', hash = '', scale = 1, touch = false } = {},
  ) {
    const file = join(folder, `${count++}.html`);
    writeFileSync(file, html);
    const context = await browser.newContext({
      viewport: { width, height },
      colorScheme: scheme,
      reducedMotion: motion,
      deviceScaleFactor: scale,
      hasTouch: touch,
    });
    const page = await context.newPage();
    page.setDefaultTimeout(60_000);
    const faults = [];
    const requests = [];
    page.on('console', (message) => ['error', 'warning'].includes(message.type()) && faults.push(message.text()));
    page.on('pageerror', (error) => faults.push(String(error)));
    page.on('request', (request) => requests.push(request.url()));
    const url = pathToFileURL(file).href;
    await page.goto(url + hash);
    await page.evaluate(() => window.impinge?.ready);
    await settled(page);
    const close = async ({ ignoring } = {}) => {
      const told = faults.filter((fault) => !ignoring?.test(fault) && !/GPU stall due to ReadPixels/.test(fault));
      assert.deepEqual(told, [], 'nothing is told on the console');
      const others = requests.filter((request) => request.split('#')[0] !== url && !request.startsWith('data:'));
      assert.deepEqual(others, [], 'nothing is requested');
      await context.close();
    };
    return { page, close };
  }

  /** Opens a page, of a text or of data blocks, that is checked and closed where the test ends. */
  async function visit(t, content, options) {
    const { page, close } = await open(typeof content === 'string' ? content : compose(content), options);
    t.after(() => close());
    return page;
  }

  /** Opens a page for several tests: `take` gives it back the choices and the stand of the camera that it began with. */
  async function share(html, options) {
    const { page, close } = await open(html, options);
    shared.push(close);
    await page.evaluate(() => {
      const { store, stand } = window.impinge;
      window.fresh = structuredClone({ state: store.state, stand: stand() });
    });
    const take = async () => {
      await page.mouse.move(0, 0);
      await page.evaluate(() => {
        document.activeElement.blur();
        const { state, stand } = structuredClone(window.fresh);
        window.impinge.store.set(state);
        Object.assign(window.impinge.stand(), stand);
      });
      await settled(page);
      return page;
    };
    return { page, take };
  }

  return {
    open,
    visit,
    share,
    stop: async () => {
      try {
        for (const close of shared) await close();
      } finally {
        await browser.close();
        rmSync(folder, { recursive: true });
      }
    },
  };
}

/** A browser for the tests of a suite. They share the page of this text, if there is one. */
export function suiteBrowser(html) {
  const browser = {};
  before(async () => {
    Object.assign(browser, await startBrowser());
    if (html !== undefined) Object.assign(browser, await browser.share(html));
  });
  after(() => browser.stop());
  return browser;
}

/** What the rows of a list say, by scrolling through all of it: for each the texts of what matches the selector. */
export function listed(page, selector = '.rank', list = '#clash-list') {
  return page.evaluate(
    async ([selector, list]) => {
      const host = document.querySelector(list);
      const rows = new Map();
      const before = host.scrollTop;
      const drawn = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
      for (host.scrollTop = 0; ; host.scrollTop += host.clientHeight / 2) {
        await drawn();
        for (const row of host.querySelectorAll('.row'))
          rows.set(Number(row.dataset.index), row.querySelector(selector)?.textContent ?? null);
        if (host.scrollTop + host.clientHeight >= host.scrollHeight - 1) break;
      }
      host.scrollTop = before;
      await drawn();
      return [...rows].sort((x, y) => x[0] - y[0]).map(([, text]) => text);
    },
    [selector, list],
  );
}

/**
 * A picture of an element, how many colours it has and how many pixels each (`seen`). `a` and `b`: the shares of it that have
 * the full colours of the first and of the second part of a clash, which are blue and orange.
 */
export async function picture(page, selector = '#canvas') {
  const box = await page.locator(selector).boundingBox();
  const png = await page.screenshot({ clip: box });
  const seen = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data: bytes } = context.getImageData(0, 0, image.width, image.height);
    const seen = new Map();
    for (let i = 0; i < bytes.length; i += 4) {
      const colour = (bytes[i] << 16) | (bytes[i + 1] << 8) | bytes[i + 2];
      seen.set(colour, (seen.get(colour) ?? 0) + 1);
    }
    return [...seen];
  }, png.toString('base64'));
  const count = (keeps) => seen.reduce((sum, [colour, pixels]) => sum + (keeps((colour >> 16) - (colour & 255)) ? pixels : 0), 0);
  const size = count(() => true);
  return {
    png,
    seen,
    count: seen.length,
    most: Math.max(...seen.map(([, pixels]) => pixels)) / size,
    a: count((redder) => redder < -60) / size,
    b: count((redder) => redder > 100) / size,
  };
}

/** The frames that are asked for have been drawn. */
export const settled = (page) =>
  page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))),
  );

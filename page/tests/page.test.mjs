// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The page as a whole: what it contains, colours, widths, messages, what a browser lacks.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { compose } from './compose.mjs';
import { listed, settled, startBrowser, suiteBrowser } from './browser.mjs';
import { kLong, kMarkup, review, reviewPage } from './fixture.mjs';

const { report, scene, geometry } = review();

test('a page has the licences of what it contains', () => {
  const licence = readFileSync(new URL('../node_modules/three/LICENSE', import.meta.url), 'utf8').trim();
  assert.ok(compose({}).includes(licence));
});
describe('the page', () => {
  const browser = suiteBrowser(reviewPage());

  test('shows names as text, whatever they hold', async () => {
    const page = await browser.take();
    assert.equal(await page.evaluate(() => window.broken), undefined);
    assert.equal(await page.locator('#parts-tree img, #clash-list img, #details-body b').count(), 0);
    const names = await listed(page, '.name', '#parts-tree');
    assert.ok(names.includes(kMarkup));
    assert.ok(names.includes('left\\u202eright\\nnext\\x00line'), 'characters that steer are spelled out');
    assert.ok(
      names.some((name) => name.startsWith('long/') && name.length < kLong.length / 10),
      'a long name is cut',
    );
  });

  test('has nothing to scroll sideways at 320 pixels', async (t) => {
    const page = await browser.visit(t, reviewPage(), { width: 320, height: 256, hash: '#clash=1' });
    for (const pane of ['clashes', 'details', 'parts']) {
      await page.click(`#panes [data-pane=${pane}]`);
      assert.ok(await page.locator(`#${pane}`).isVisible());
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 320), pane);
    }
  });

  test('cuts no figure of a clash, however narrow the pane', async (t) => {
    const page = await browser.visit(t, reviewPage(), { width: 320, height: 640, hash: '#clash=1' });
    for (const width of [320, 900, 1000]) {
      await page.setViewportSize({ width, height: 640 });
      if (width < 900) await page.click('#panes [data-pane=details]');
      const cut = await page.evaluate(() =>
        [...document.querySelectorAll('#details-body dd')]
          .filter((dd) => dd.scrollWidth > dd.clientWidth)
          .map((dd) => `${dd.previousElementSibling.textContent}: ${dd.scrollWidth} > ${dd.clientWidth}`),
      );
      assert.deepEqual(cut, [], `${width} pixels`);
    }
  });

  test('is light or dark as the system is, until the button says otherwise', async () => {
    const page = await browser.take();
    const ground = () => page.evaluate(() => getComputedStyle(document.getElementById('parts')).backgroundColor);
    await page.emulateMedia({ colorScheme: 'dark' });
    await settled(page);
    const dark = await ground();
    await page.click('#theme-button');
    const light = await ground();
    assert.notEqual(dark, light);
    await page.emulateMedia({ colorScheme: 'light' });
    assert.equal(await ground(), light);
    await page.keyboard.press('t');
    assert.equal(await ground(), dark);
  });

  test('text has a contrast of 4.5 or more, light and dark', async (t) => {
    const page = await browser.visit(t, reviewPage(), { hash: '#clash=3' });
    // A clash of each verdict is the chosen one.
    const chosen = await page.evaluate(() => [...new Map(window.impinge.clashes.map((one) => [one.verdict, one.rank])).values()]);
    for (const [scheme, rank] of ['light', 'dark'].flatMap((scheme) => chosen.map((rank) => [scheme, rank]))) {
      await page.emulateMedia({ colorScheme: scheme });
      await page.evaluate((rank) => (location.hash = `#clash=${rank}`), rank);
      await settled(page);
      const poor = await page.evaluate(() => {
        const parse = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
        const light = ([r, g, b]) =>
          [r, g, b]
            .map((c) => ((c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
            .reduce((s, c, i) => s + c * [0.2126, 0.7152, 0.0722][i], 0);
        const groundOf = (element) => {
          for (let e = element; e; e = e.parentElement) {
            const colour = parse(getComputedStyle(e).backgroundColor);
            if (colour.length === 3 || colour[3] === 1) return colour;
          }
          return [255, 255, 255];
        };
        const found = [];
        for (const element of document.querySelectorAll('body *')) {
          const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
          if (!own || !element.checkVisibility() || element.closest(':disabled, script, #cube')) continue;
          const [x, y] = [light(parse(getComputedStyle(element).color)), light(groundOf(element))];
          const contrast = (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05);
          if (contrast < 4.5)
            found.push(
              `${element.tagName}.${element.className} ${element.textContent.slice(0, 20)} ${contrast.toFixed(2)}`,
            );
        }
        return found;
      });
      assert.deepEqual(poor, [], `${scheme}, clash ${rank}`);
    }
  });

  test('shows a model without clashes', async (t) => {
    const plain = { ...report, settings: null, pairs: [], counts: null, resolved: undefined };
    const page = await browser.visit(t, { report: plain, scene, geometry });
    assert.ok(!(await page.locator('#clashes').isVisible()));
    assert.equal((await listed(page, '.name', '#parts-tree')).length, 18);
    assert.equal(await page.textContent('#verdict-line'), '');
  });

  test('what could not be read of the files is said on top, and if the model was simplified', async (t) => {
    const missing = [`a.dae: ${kMarkup}`];
    const warnings = ['b.stl may be in mm'];
    const much = { ...scene, triangles: 123456789, shown: 1000000 };
    const page = await browser.visit(t, { report: { ...report, missing, warnings }, scene: much, geometry });
    const said = [`not read: a.dae: ${kMarkup}`, 'warning: b.stl may be in mm'];
    assert.deepEqual(await page.locator('#facts .left-out').allTextContents(), said);
    assert.match(await page.textContent('#facts'), /simplified to 1.000.000 of 123.456.789 triangles; figures/);
    const few = { ...scene, triangles: 9999, shown: 1100, asked: 1000 };
    const other = await browser.visit(t, { report, scene: few, geometry });
    assert.match(
      await other.textContent('#facts'),
      /simplified to 1.100 of 9.999 triangles, as with fewer parts would lose their shape; figures/,
    );
  });

  test('tells of what it cannot read, and shows the rest', async (t) => {
    const cut = geometry.slice(0, 40);
    for (const [blocks, words] of [
      [{ report, scene: { ...scene, objects: [] }, geometry }, /they do not belong together/],
      [{ report, scene, geometry: cut }, /geometry cannot be read/],
      [{ scene, geometry }, /the block “report” is missing/],
    ]) {
      const page = await browser.visit(t, blocks);
      assert.match(await page.textContent('#trouble'), words);
      assert.ok(await page.locator('#trouble').isVisible());
      if (blocks.report) assert.equal((await listed(page)).length, report.pairs.length, 'the list is there all the same');
    }
  });
});

test('without WebGL the list and the figures are complete', async () => {
  const browser = await startBrowser({ webgl: false });
  try {
    const { page, close } = await browser.open(reviewPage());
    assert.match(await page.textContent('#stage-note'), /offers no WebGL 2/);
    assert.equal((await listed(page)).length, report.pairs.length);
    await page.locator('#clash-list .row').first().click();
    assert.match(await page.textContent('#details-body'), /is a duplicate of/);
    for (const key of ['f', '1', 's', 'e', 'x', 'p', 'h', 'i', 'a', 'Escape']) await page.keyboard.press(key);
    await close({ ignoring: /WebGL/ });
  } finally {
    await browser.stop();
  }
});

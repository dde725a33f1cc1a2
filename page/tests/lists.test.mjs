// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The parts of the page that are read: lists, filters, figures, messages. Expected orders are worked out here from the report.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, describe, test } from 'node:test';
import { blocksOf, compose } from './compose.mjs';
import { listed, settled, startBrowser } from './browser.mjs';
import { kLong, kMarkup, review, reviewPage } from './fixture.mjs';

const kOrder = ['duplicate', 'inside', 'penetrating', 'crossing', 'touching', 'apart'];
const { report, scene, geometry } = review();
const depth = (pair) =>
  pair.overlap_depth ? Math.max(pair.overlap_depth.a_in_b[1], pair.overlap_depth.b_in_a[1]) : NaN;
const area = (pair) => pair.regions.reduce((sum, region) => sum + region.area, 0);
const last = (x, y, sign) => (Number.isNaN(x) || Number.isNaN(y) ? Number.isNaN(x) - Number.isNaN(y) : sign * (x - y));
const ranked = report.pairs
  .map((pair, i) => ({ pair, i }))
  .sort(
    (x, y) =>
      kOrder.indexOf(x.pair.verdict) - kOrder.indexOf(y.pair.verdict) ||
      last(depth(x.pair), depth(y.pair), -1) ||
      last(x.pair.distance ?? NaN, y.pair.distance ?? NaN, 1) ||
      x.i - y.i,
  )
  .map(({ pair }) => pair);
const rankOf = (pair) => String(ranked.indexOf(pair) + 1);
const ranksOf = (keep) => ranked.filter(keep).map(rankOf);
const changeOf = ({ change, regions }) =>
  change === 'persisting' && regions.some((region) => region.change === 'new') ? 'new region' : change;
const nameOf = (id) => report.objects[id].name;

test('a page has the licences of what it contains', () => {
  const licence = readFileSync(new URL('../node_modules/three/LICENSE', import.meta.url), 'utf8').trim();
  assert.ok(compose({}).includes(licence));
});

describe('the list of clashes', () => {
  let browser;
  let page;
  let close;
  before(async () => {
    browser = await startBrowser();
    ({ page, close } = await browser.open(reviewPage()));
  });
  after(async () => {
    try {
      await close();
    } finally {
      await browser.stop();
    }
  });
  const clear = async () => {
    if (await page.locator('#clear-filters').isVisible()) await page.click('#clear-filters');
  };

  test('holds every pair of the report, in the order of the table', async () => {
    assert.deepEqual(await listed(page), ranked.map(rankOf));
    assert.equal(await page.textContent('#clashes-count'), String(report.pairs.length));
    assert.equal(await page.getAttribute('#clash-list', 'aria-rowcount'), String(report.pairs.length));
    const first = await listed(page, '.names');
    assert.match(first[1], /^post \(2\)lies inside plate \(2\)$/, 'the inner part stands first');
  });

  test('is summed up', async () => {
    assert.match(await page.textContent('#verdict-line'), /^6 clashes fail/);
    const facts = await page.textContent('#facts');
    for (const fact of [
      '12 parts in 2 files',
      '12 solids',
      '6 new, 1 with a new region, 5 persisting, 1 resolved, 1 of twins, not known which; 1 worse than before',
      'deepest overlap 1.25',
      'clearance 0.5',
    ]) {
      assert.ok(facts.includes(fact), `${fact} in ${facts}`);
    }
  });

  for (const [key, by] of [
    ['depth', (x, y) => last(depth(x), depth(y), -1)],
    ['distance', (x, y) => last(x.distance ?? NaN, y.distance ?? NaN, 1)],
    ['area', (x, y) => area(y) - area(x)],
  ]) {
    test(`is sorted by ${key}`, async () => {
      await page.selectOption('#sort', key);
      const expected = [...ranked].sort((x, y) => by(x, y) || ranked.indexOf(x) - ranked.indexOf(y));
      assert.deepEqual(await listed(page), expected.map(rankOf));
      await page.selectOption('#sort', 'rank');
    });
  }

  test('is sorted by name', async () => {
    await page.selectOption('#sort', 'name');
    const bolts = (await listed(page, '.first')).filter((name) => name.startsWith('bolt'));
    assert.deepEqual(bolts, ['bolt', 'bolt', 'bolt', 'bolt (2)', 'bolt (3)']);
    await page.selectOption('#sort', 'rank');
  });

  test('is filtered by verdicts', async () => {
    await page.click('.chip.apart');
    assert.deepEqual(
      await listed(page),
      ranksOf((pair) => pair.verdict === 'apart'),
    );
    await page.click('.chip.duplicate');
    assert.deepEqual(
      await listed(page),
      ranksOf((pair) => ['apart', 'duplicate'].includes(pair.verdict)),
    );
    assert.equal(await page.getAttribute('.chip.duplicate', 'aria-pressed'), 'true');
    assert.equal(await page.textContent('#clashes-count'), '4 of 12');
    await clear();
    await page.click('.chip.failing');
    assert.deepEqual(
      await listed(page),
      ranksOf((pair) => pair.fails),
    );
    await clear();
    assert.deepEqual(await listed(page), ranked.map(rankOf));
  });

  test('is filtered by words', async () => {
    await page.fill('#clash-search', 'PLATE bolt');
    assert.deepEqual(
      await listed(page),
      ranksOf((pair) => {
        const names = `${nameOf(pair.a)} ${nameOf(pair.b)}`;
        return names.includes('plate') && names.includes('bolt');
      }),
    );
    await page.fill('#clash-search', 'no such part');
    assert.deepEqual(await listed(page), []);
    await clear();
  });

  test('is filtered by depth and by distance', async () => {
    await page.fill('#depth-from', '0.6');
    assert.deepEqual(
      await listed(page),
      ranksOf((pair) => depth(pair) >= 0.6),
    );
    await clear();
    await page.fill('#distance-to', '0.25');
    assert.deepEqual(
      await listed(page),
      ranksOf((pair) => pair.distance !== null && pair.distance <= 0.25),
    );
    await clear();
  });

  test('is filtered by what triage says', async () => {
    for (const [key, value] of [
      ['test', 'bolts against plates'],
      ['status', 'approved'],
      ['change', 'new'],
      ['change', 'new region'],
      ['change', 'persisting'],
    ]) {
      await page.selectOption(`#filter-${key}`, value);
      assert.deepEqual(
        await listed(page),
        ranksOf((pair) => (key === 'change' ? changeOf(pair) : pair[key]) === value),
        `${key} ${value}`,
      );
      await clear();
    }
    await page.click('.chip.resolved');
    assert.deepEqual(await listed(page), [ranked.length + 1, ranked.length + 2].map(String));
    await clear();
  });

  test('is filtered by a part of the tree', async () => {
    const row = page.locator('#parts-tree .row', { hasText: 'far bolt' });
    await row.click();
    await page.getByRole('button', { name: 'Only its clashes' }).click();
    assert.deepEqual(
      await listed(page),
      ranksOf((pair) => pair.a === 10 || pair.b === 10),
    );
    await clear();
    await page.keyboard.press('Escape');
  });

  test('is grouped by part, by types and by test', async () => {
    await page.selectOption('#group', 'part');
    const sizes = new Map();
    for (const pair of report.pairs) for (const id of [pair.a, pair.b]) sizes.set(id, (sizes.get(id) ?? 0) + 1);
    const groups = await listed(page, '.group-title .name');
    assert.equal(groups.filter((title) => title !== null).length, sizes.size);
    assert.equal(
      groups.filter((title) => title === null).length,
      2 * report.pairs.length,
      'each clash under both parts',
    );
    await page.selectOption('#group', 'types');
    const types = new Set(report.pairs.map(({ a, b }) => [scene.objects[a].mesh, scene.objects[b].mesh].sort().join()));
    assert.equal((await listed(page, '.group-title .name')).filter((title) => title !== null).length, types.size);
    await page.locator('#clash-list .clash-group').first().click();
    assert.ok(
      (await listed(page)).filter((rank) => rank !== null).length < report.pairs.length,
      'a closed group hides its clashes',
    );
    await page.locator('#clash-list .clash-group').first().click();
    await page.selectOption('#group', 'test');
    assert.deepEqual(
      new Set(await listed(page, '.group-title .name')),
      new Set([null, 'No named test', 'bolts against plates']),
    );
    await page.selectOption('#group', 'none');
  });

  test('shows all figures of a clash', async () => {
    const pair = report.pairs[0];
    await page.evaluate((rank) => (location.hash = `#clash=${rank}`), rankOf(pair));
    await settled(page);
    const text = await page.textContent('#details-body');
    for (const figure of [
      '0.5072 to 0.5123',
      '0.4611 to 0.4867',
      '2.5',
      '12 crossing, 3 touching, 1 coplanar',
      '2 regions of contact',
      'seen by <b>two</b>',
      'approved',
      'persisting, and worse: it was touching',
      '0000-0',
    ]) {
      assert.ok(text.includes(figure), `${figure} in ${text}`);
    }
    assert.equal(await page.locator('#details-body .number[title="0.51234567"]').count(), 1, 'all digits in the title');
    assert.match(await page.textContent('#live'), /^Clash \d+ of 14: bolt penetrates plate, depth 0.5123$/);
    await page.evaluate((rank) => (location.hash = `#clash=${rank}`), rankOf(report.pairs[1]));
    await settled(page);
    assert.match(await page.textContent('#details-body'), /Note: they overlap by no more than the tolerance\./);
    await page.keyboard.press('Escape');
    assert.ok(!page.url().includes('#'));
  });

  test('shows what people wrote in its lines', async () => {
    for (const [pair, lines] of [
      [report.pairs[0], ['seen by <b>two</b>', 'not by\\u202e three', 'or four']],
      [report.pairs[4], ['one', 'two']],
    ]) {
      await page.evaluate((rank) => (location.hash = `#clash=${rank}`), rankOf(pair));
      await settled(page);
      const remark = page.locator('#details-body .remark');
      assert.equal(await remark.innerText(), lines.join('\n'));
      assert.equal(await remark.textContent(), lines.join('\n'), 'each character but those of line breaks is seen');
      const height = await remark.evaluate(
        (one) => one.getBoundingClientRect().height / parseFloat(getComputedStyle(one).lineHeight),
      );
      assert.ok(height > lines.length - 0.5, `${height} lines`);
    }
    await page.keyboard.press('Escape');
  });

  test('tells of twins', async () => {
    const [gone, ambiguous] = [ranked.length + 1, ranked.length + 2];
    const told = [];
    for (const rank of [rankOf(report.pairs[0]), rankOf(report.pairs[1]), gone, ambiguous]) {
      await page.evaluate((one) => (location.hash = `#clash=${one}`), rank);
      await settled(page);
      told.push(await page.textContent('#details-body'));
    }
    assert.deepEqual(
      told.map((text) => text.includes('has a twin of the same name, shape and place')),
      [false, true, false, true],
    );
    assert.match(told[1], /no status or comment is carried over/);
    assert.match(told[2], /Changeresolved/);
    assert.match(told[3], /Changenot known: it may still be there/);
    await page.keyboard.press('Escape');
    await page.click('.chip.resolved');
    assert.deepEqual(await listed(page, '.tag'), ['resolved', 'of a twin']);
    await clear();
  });

  test('marks what got worse', async () => {
    const marked = ranked.filter((pair) => pair.was && kOrder.indexOf(pair.verdict) < kOrder.indexOf(pair.was));
    assert.deepEqual(marked, [report.pairs[0]]);
    const rows = await listed(page, '.tags');
    assert.deepEqual(
      ranked.filter((_, i) => rows[i]?.includes('worse')),
      marked,
    );
  });

  test('marks known clashes with a new region', async () => {
    const marked = ranked.filter((pair) => changeOf(pair) === 'new region');
    assert.deepEqual(marked, [report.pairs[4]]);
    const rows = await listed(page, '.tags');
    assert.deepEqual(
      ranked.filter((_, i) => rows[i]?.includes('new region')),
      marked,
    );
    await page.evaluate((rank) => (location.hash = `#clash=${rank}`), rankOf(marked[0]));
    await settled(page);
    assert.match(await page.textContent('#details-body'), /Changepersisting, with a new region(?!,)/);
    await page.keyboard.press('Escape');
  });

  test('is gone through with the keyboard', async () => {
    await page.focus('#clash-list');
    await page.keyboard.press('Home');
    await page.keyboard.press('ArrowDown');
    const current = await page.getAttribute('#clash-list', 'aria-activedescendant');
    assert.equal(await page.textContent(`#${current} .rank`), '2');
    await page.keyboard.press('Enter');
    assert.ok(page.url().endsWith('#clash=2'));
    assert.equal(
      await page.getAttribute(`#${await page.getAttribute('#clash-list', 'aria-activedescendant')}`, 'aria-selected'),
      'true',
    );
    await page.keyboard.press('j');
    assert.ok(page.url().endsWith('#clash=3'));
    await page.keyboard.press('k');
    await page.keyboard.press('k');
    assert.ok(page.url().endsWith('#clash=1'));
    await page.keyboard.press('k');
    assert.ok(page.url().endsWith('#clash=1'), 'there is none before the first');
    await page.keyboard.press('Escape');
    assert.ok(!page.url().includes('#clash'));
    await page.keyboard.press('/');
    assert.equal(await page.evaluate(() => document.activeElement.id), 'clash-search');
    await page.keyboard.type('j?');
    assert.equal(await page.inputValue('#clash-search'), 'j?', 'keys in a field are text');
    await clear();
    await page.focus('#clash-list');
    await page.keyboard.press('?');
    assert.ok(await page.evaluate(() => document.getElementById('help').open));
    await page.keyboard.press('Escape');
    assert.ok(!(await page.evaluate(() => document.getElementById('help').open)));
  });

  test('everything can be reached with Tab, and the focus is seen', async () => {
    await page.focus('#facts button');
    const reached = new Set();
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press('Tab');
      const [id, outline] = await page.evaluate(() => [
        document.activeElement === document.body
          ? ''
          : document.activeElement.id || document.activeElement.className || document.activeElement.textContent,
        getComputedStyle(document.activeElement).outlineStyle,
      ]);
      if (id) assert.notEqual(outline, 'none', `focus on ${id}`);
      reached.add(id);
    }
    for (const id of [
      'theme-button',
      'help-button',
      'canvas',
      'fit',
      'section-button',
      'explode-button',
      'look-button',
      'parts-search',
      'parts-tree',
      'clash-search',
      'sort',
      'group',
      'clash-list',
    ]) {
      assert.ok(reached.has(id), id);
    }
  });
});

describe('the tree of parts', () => {
  let browser;
  before(async () => (browser = await startBrowser()));
  after(() => browser.stop());

  test('lists files, groups and parts; search leaves what matches and the way to it', async () => {
    const { page, close } = await browser.open(reviewPage());
    const names = await listed(page, '.name', '#parts-tree');
    assert.equal(names.length, 12 + 2 + 4, 'parts, files and the groups frame, left, right, far');
    await page.fill('#parts-search', 'bolt FRAME');
    assert.deepEqual(await listed(page, '.name', '#parts-tree'), [
      'left.stl',
      'frame',
      'left',
      'bolt',
      'bolt (2)',
      'right',
      'bolt (3)',
    ]);
    await page.fill('#parts-search', '');
    await page.focus('#parts-tree');
    await page.keyboard.press('Home');
    await page.keyboard.press('ArrowLeft');
    assert.deepEqual((await listed(page, '.name', '#parts-tree')).slice(0, 2), ['left.stl', 'right.stl'], 'closed');
    await close();
  });

  test('counts in red what fails, and nothing else', async () => {
    const nothing = report.pairs.map((pair) => ({ ...pair, fails: false }));
    for (const pairs of [report.pairs, nothing]) {
      const { page, close } = await browser.open(compose({ report: { ...report, pairs }, scene, geometry }), {
        height: 1600,
      });
      const red = await page.evaluate(() => {
        const bad = document.createElement('i');
        bad.style.color = 'var(--bad)';
        document.body.append(bad);
        const colour = getComputedStyle(bad).color;
        bad.remove();
        return [...document.querySelectorAll('#parts-tree .row')]
          .filter((row) => getComputedStyle(row.querySelector('.badge')).color === colour)
          .map((row) => row.querySelector('.name').textContent);
      });
      const failing = report.objects.filter(({ id }) =>
        pairs.some((pair) => pair.fails && (pair.a === id || pair.b === id)),
      );
      assert.equal(red.length, failing.length);
      for (const name of ['bolt', 'plate', 'post'])
        assert.equal(red.includes(name), failing.some((one) => one.name === name), name);
      await close();
    }
  });

  test('hides, isolates and shows', async () => {
    const { page, close } = await browser.open(reviewPage());
    await page.focus('#parts-tree');
    await page.keyboard.press('Home');
    await page.keyboard.press('h');
    assert.equal(await page.textContent('#parts-count'), '12, 6 hidden');
    await page.keyboard.press('i');
    assert.equal(await page.textContent('#parts-count'), '12, 6 hidden');
    await page.click('#show-all');
    assert.equal(await page.textContent('#parts-count'), '12');
    await close();
  });
});

describe('the page', () => {
  let browser;
  before(async () => (browser = await startBrowser()));
  after(() => browser.stop());

  test('shows names as text, whatever they hold', async () => {
    const { page, close } = await browser.open(reviewPage());
    assert.equal(await page.evaluate(() => window.broken), undefined);
    assert.equal(await page.locator('#parts-tree img, #clash-list img, #details-body b').count(), 0);
    const names = await listed(page, '.name', '#parts-tree');
    assert.ok(names.includes(kMarkup));
    assert.ok(names.includes('left\\u202eright\\nnext\\x00line'), 'characters that steer are spelled out');
    assert.ok(
      names.some((name) => name.startsWith('long/') && name.length < kLong.length / 10),
      'a long name is cut',
    );
    await close();
  });

  test('has nothing to scroll sideways at 320 pixels', async () => {
    const { page, close } = await browser.open(reviewPage(), { width: 320, height: 256, hash: '#clash=1' });
    for (const pane of ['clashes', 'details', 'parts']) {
      await page.click(`#panes [data-pane=${pane}]`);
      assert.ok(await page.locator(`#${pane}`).isVisible());
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 320), pane);
    }
    await close();
  });

  test('is light or dark as the system is, until the button says otherwise', async () => {
    const { page, close } = await browser.open(reviewPage(), { scheme: 'dark' });
    const ground = () => page.evaluate(() => getComputedStyle(document.getElementById('parts')).backgroundColor);
    const dark = await ground();
    await page.click('#theme-button');
    const light = await ground();
    assert.notEqual(dark, light);
    await page.emulateMedia({ colorScheme: 'light' });
    assert.equal(await ground(), light);
    await page.keyboard.press('t');
    assert.equal(await ground(), dark);
    await close();
  });

  test('text has a contrast of 4.5 or more, light and dark', async () => {
    for (const scheme of ['light', 'dark']) {
      const { page, close } = await browser.open(reviewPage(), { scheme, hash: '#clash=3' });
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
      assert.deepEqual(poor, [], scheme);
      await close();
    }
  });

  test('shows a model without clashes', async () => {
    const plain = { ...report, settings: null, pairs: [], counts: null, resolved: undefined };
    const { page, close } = await browser.open(compose({ report: plain, scene, geometry }));
    assert.ok(!(await page.locator('#clashes').isVisible()));
    assert.equal((await listed(page, '.name', '#parts-tree')).length, 18);
    assert.equal(await page.textContent('#verdict-line'), '');
    await close();
  });

  test('says so if the model was simplified', async () => {
    const { page, close } = await browser.open(
      compose({ report, scene: { ...scene, triangles: 123456789, shown: 1000000 }, geometry }),
    );
    assert.match(await page.textContent('#facts'), /simplified to 1.000.000 of 123.456.789 triangles; figures/);
    await close();
    const more = await browser.open(
      compose({ report, scene: { ...scene, triangles: 9999, shown: 1100, asked: 1000 }, geometry }),
    );
    assert.match(
      await more.page.textContent('#facts'),
      /simplified to 1.100 of 9.999 triangles, as with fewer parts would lose their shape; figures/,
    );
    await more.close();
  });

  const broken = {
    'no report': [{ scene, geometry }, /the block “report” is missing/],
    'a report that is not JSON': [{ report: '{"version":1,', scene, geometry }, /“report” is not JSON/],
    'a report of another version': [
      { report: { ...report, version: 7 }, scene, geometry },
      /version 7, and this page reads version 1/,
    ],
    'a pair of no parts': [
      { report: { ...report, pairs: [{ ...report.pairs[0], b: 99 }] }, scene, geometry },
      /its pair 0 names no two parts/,
    ],
    'no scene': [{ report, geometry }, /the block “scene” is missing/],
    'a scene of another report': [
      { report, scene: { ...scene, objects: [] }, geometry },
      /0 objects, but the report has 12 parts/,
    ],
    'a pose that is none': [
      { report, scene: { ...scene, objects: scene.objects.map(() => ({ mesh: 0, pose: [1] })) }, geometry },
      /its object 0 has no mesh or no pose/,
    ],
    'no geometry': [{ report, scene }, /the block “geometry” is missing/],
    'geometry cut short': [{ report, scene, geometry: geometry.slice(0, 40) }, /geometry cannot be read/],
    'geometry of noise': [{ report, scene, geometry: '!!!!' }, /geometry cannot be read/],
    'geometry of too few bytes': [
      {
        report,
        scene: { ...scene, meshes: scene.meshes.map((mesh) => ({ ...mesh, triangles: mesh.triangles + 1 })) },
        geometry,
      },
      /geometry cannot be read/,
    ],
  };
  for (const [what, [blocks, words]] of Object.entries(broken)) {
    test(`tells of ${what}`, async () => {
      const { page, close } = await browser.open(compose(blocks));
      assert.match(await page.textContent('#trouble'), words);
      assert.ok(await page.locator('#trouble').isVisible());
      if (
        blocks.report &&
        typeof blocks.report === 'object' &&
        words.source.match(/geometry|scene|objects,|object 0/)
      ) {
        assert.equal((await listed(page)).length, report.pairs.length, 'the list is there all the same');
      }
      await close();
    });
  }

  test('blocks hold no sequence that ends them', () => {
    assert.equal(blocksOf({ report }).match(/<\/script/g).length, 1);
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

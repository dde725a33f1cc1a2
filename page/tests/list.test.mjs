// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The list of clashes: order, filters, figures. Expected orders are worked out here from the report.
import assert from 'node:assert/strict';
import { before, describe, test } from 'node:test';
import { listed, settled, suiteBrowser } from './browser.mjs';
import { review, reviewPage } from './fixture.mjs';

const kOrder = ['duplicate', 'inside', 'penetrating', 'crossing', 'touching', 'apart'];
const { report, scene } = review();
const depth = (pair) =>
  pair.overlap_depth ? Math.max(pair.overlap_depth.a_in_b[1], pair.overlap_depth.b_in_a?.[1] ?? 0) : NaN;
const failsBelow = (pair) => pair.fails_below ?? Infinity;
const area = (pair) => pair.regions.reduce((sum, region) => sum + region.area, 0);
const last = (x, y, sign) => (Number.isNaN(x) || Number.isNaN(y) ? Number.isNaN(x) - Number.isNaN(y) : sign * (x - y));
const rankedOf = (pairs) =>
  pairs
    .map((pair, i) => ({ pair, i }))
    .sort(
      (x, y) =>
        Math.max(kOrder.indexOf(x.pair.verdict), 3) - Math.max(kOrder.indexOf(y.pair.verdict), 3) ||
        last(failsBelow(y.pair), failsBelow(x.pair), 1) ||
        (depth(y.pair) || 0) - (depth(x.pair) || 0) ||
        kOrder.indexOf(x.pair.verdict) - kOrder.indexOf(y.pair.verdict) ||
        area(y.pair) - area(x.pair) ||
        (x.pair.distance ?? 0) - (y.pair.distance ?? 0) ||
        x.i - y.i,
    )
    .map(({ pair }) => pair);
const ranked = rankedOf(report.pairs);
const rankOf = (pair) => String(ranked.indexOf(pair) + 1);
const ranksOf = (keep) => ranked.filter(keep).map(rankOf);
const changeOf = ({ change, regions }) =>
  change === 'persisting' && regions.some((region) => region.change === 'new') ? 'new region' : change;
const isWorse = ({ was, verdict }) => was !== null && kOrder.indexOf(verdict) < kOrder.indexOf(was);
const nameOf = (id) => report.objects[id].name;
const traitOf = (id, key) => (key === 'file' ? report.objects[id].file : report.objects[id].properties[key]) ?? `without ${key}`;

describe('the list of clashes', () => {
  const browser = suiteBrowser(reviewPage());
  let page;
  before(() => ({ page } = browser));
  const clear = async () => {
    if (await page.locator('#clear-filters').isVisible()) await page.click('#clear-filters');
  };

  const lists = async (keep, what) => assert.deepEqual(await listed(page), ranksOf(keep), what);
  const choose = async (rank) => {
    await page.evaluate((rank) => (location.hash = `#clash=${rank}`), rank);
    await settled(page);
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
      '6 new, 1 with a new region, 5 persisting, 2 resolved; 1 worse than before',
      'deepest overlap 1.25',
      'clearance 0.5',
      'lengths in mm',
    ]) {
      assert.ok(facts.includes(fact), `${fact} in ${facts}`);
    }
    const behind = (place) => page.locator(place).first().evaluate((span) => getComputedStyle(span, '::after').content);
    assert.equal(await behind('#facts .in-unit-1'), '"\u00a0mm"', 'a length has its unit');
    const told = await page.locator('#clash-list .side').allTextContents();
    assert.ok(told.includes('volume 0.0625\u00a0mm³'), told);
  });

  test('says what fails: the words of the call, or the modes of the tests', async (t) => {
    const tests = [{ name: 'bolts against plates', mode: 'contact' }];
    for (const [more, failOn, told] of [
      [{}, ['penetration', 'inside'], 'fails on penetration, inside'],
      [{ tests: [] }, [], 'fails on nothing'],
      [{ tests }, [], 'fails by the mode of each test'],
      [{ tests }, ['new'], 'fails by the mode of each test, only what is new'],
    ]) {
      const settings = { ...report.settings, fail_on: failOn };
      const page = await browser.visit(t, { report: { ...report, ...more, settings } });
      const facts = await page.locator('#facts > span').allTextContents();
      assert.deepEqual(facts.filter((fact) => fact.startsWith('fails')), [told]); // prettier-ignore
    }
  });

  for (const [key, by] of [
    ['depth', (x, y) => last(depth(x), depth(y), -1)],
    ['volume', (x, y) => last(x.overlap_volume ?? NaN, y.overlap_volume ?? NaN, -1)],
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
    await lists((pair) => pair.verdict === 'apart');
    await page.click('.chip.duplicate');
    await lists((pair) => ['apart', 'duplicate'].includes(pair.verdict));
    assert.equal(await page.getAttribute('.chip.duplicate', 'aria-pressed'), 'true');
    assert.equal(await page.textContent('#clashes-count'), '4 of 12');
    await clear();
    await page.click('.chip.failing');
    await lists((pair) => pair.fails);
    await clear();
    assert.deepEqual(await listed(page), ranked.map(rankOf));
  });

  test('is filtered by words', async () => {
    await page.fill('#clash-search', 'PLATE bolt');
    await lists((pair) => ['plate', 'bolt'].every((word) => `${nameOf(pair.a)} ${nameOf(pair.b)}`.includes(word)));
    await page.fill('#clash-search', 'no such part');
    assert.deepEqual(await listed(page), []);
    await clear();
  });

  test('is filtered by depth and by distance', async () => {
    await page.fill('#depth-from', '0.6');
    await lists((pair) => depth(pair) >= 0.6);
    await clear();
    await page.fill('#distance-to', '0.25');
    await lists((pair) => pair.verdict !== 'apart' || pair.distance <= 0.25);
    await clear();
  });

  test('is filtered by figures as they are shown, and as they are', async (t) => {
    const { report } = review({ triage: false });
    const [first, second, third] = report.pairs.filter((pair) => pair.verdict === 'apart');
    [first.distance, second.distance, third.distance] = [0.0100002, 0.0099998, 0.01001];
    const deep = report.pairs.filter((pair) => pair.overlap_depth);
    deep.forEach((pair, i) => (pair.overlap_depth = { a_in_b: [0, [0.0199999, 0.0200002, 0.01998, 1][i]], b_in_a: null }));
    // What lies free in another is as far as the clearance from its boundary, or farther.
    const free = report.pairs.find((pair) => pair.verdict === 'inside');
    free.touching = free.coplanar = free.crossing = 0;
    const page = await browser.visit(t, { report });
    const namesOf = (some) => some.map(({ a, b }) => `${a} ${b}`).sort();
    const ranked = rankedOf(report.pairs);
    const pairs = async (field, value) => {
      await page.fill(field, value);
      const ranks = await listed(page);
      await page.fill(field, '');
      return namesOf(ranks.map((rank) => ranked[rank - 1]));
    };
    const isMeeting = (pair) => pair.verdict !== 'apart' && pair !== free;
    for (const [value, near] of [
      ['0.01', [first, second]],
      ['0.0099999', [second]],
      ['0.0100002', [first, second]],
      ['0.01001', [first, second, third]],
      ['0', []],
    ]) {
      assert.deepEqual(await pairs('#distance-to', value), namesOf([...report.pairs.filter(isMeeting), ...near]), value);
    }
    for (const [value, found] of [
      ['0.02', [deep[0], deep[1], deep[3]]],
      ['0.0200002', [deep[1], deep[3]]],
      ['0.01998', deep],
    ])
      assert.deepEqual(await pairs('#depth-from', value), namesOf(found), value);
    await page.fill('#depth-from', '0.9');
    assert.deepEqual(await listed(page, '.main'), ['depth 0 to 1'], 'of a wide interval both ends');
  });

  describe('over the tolerance', () => {
    const pairOf = (verdict, failsBelow, more = {}) => ({
      ...report.pairs[1],
      a: 0,
      b: 1,
      verdict,
      fails: verdict === 'penetrating',
      fails_below: failsBelow,
      ...more,
    });
    const pageOf = (t, pairs, settings = {}) =>
      browser.visit(t, { report: { ...report, pairs, resolved: [], settings: { ...report.settings, ...settings } } });
    const words = (page) => page.textContent('.tolerance-words');
    const failing = [0.01, 0.02, 0.3, 4, null].map((t) => pairOf('penetrating', t, { tolerance: 0.001 }));

    test('leaves those that would still fail', async (t) => {
      const page = await pageOf(t, [...failing, pairOf('touching', 0.0005, { tolerance: 0.002 })]);
      assert.equal(await words(page), 'now: 5 pairs fail');
      const slider = page.locator('#tolerance-slider');
      assert.equal(await slider.inputValue(), String(Math.round(20 * Math.log10(0.002))));
      for (const [tolerance, told] of [
        [0.01, 'at 0.01\u00a0mm: 4 pairs fail'], // not what is as deep
        [0.32, 'at 0.32\u00a0mm: 2 pairs fail'],
        [4, 'at 4\u00a0mm: 1 pair fails'],
      ]) {
        await slider.fill(String(Math.round(20 * Math.log10(tolerance))));
        assert.equal(await words(page), told);
        assert.equal(await slider.getAttribute('aria-valuetext'), told);
        const left = await page.evaluate(() => window.impinge.visible().map((clash) => clash.pair.fails_below));
        assert.deepEqual(left, [null, 4, 0.3, 0.02, 0.01].filter((t) => t === null || t > tolerance));
      }
      assert.equal(await slider.getAttribute('max'), await slider.inputValue(), 'there the last that can go is gone');
      await slider.press('Home');
      assert.equal(await words(page), 'now: 5 pairs fail');
      await slider.press('ArrowRight');
      assert.equal(await words(page), 'at 0.0022\u00a0mm: 5 pairs fail');
      await page.click('#clear-filters');
      assert.equal(await words(page), 'now: 5 pairs fail');
    });

    test('goes below one that was chosen', async (t) => {
      const excused = [pairOf('touching', 0.05), pairOf('touching', 0)];
      const page = await pageOf(t, [...failing.slice(2), ...excused], { tolerance: 0.1 });
      assert.equal(await words(page), 'now: 3 pairs fail');
      await page.locator('#tolerance-slider').press('Home');
      assert.match(await words(page), /^at 0.04\d?\u00a0mm: 4 pairs fail$/);
    });

    test('is there where some tolerance excuses something', async (t) => {
      for (const [what, isThere, pairs, settings] of [
        ['one pair', false, failing.slice(0, 1)],
        ['two', true, failing.slice(0, 2)],
        ['two at any tolerance', false, [failing[4], failing[4]]],
        ['what fails by the words of the call', false, [pairOf('touching', 0, { fails: true }), failing[4]]],
        ['what an automatic tolerance excuses', false, [pairOf('touching', 1e-12), failing[4]]],
        ['what a chosen one excuses', true, [pairOf('touching', 0.05), failing[4]], { tolerance: 0.1 }],
        ['but not of what is new', false, [pairOf('touching', 0.05), failing[4]], { tolerance: 0.1, fail_on: ['new'] }],
        ['no tolerance', true, failing, { tolerance: 0 }],
      ]) {
        const page = await pageOf(t, pairs, settings);
        assert.equal(await page.isVisible('#tolerance'), isThere, what);
      }
    });
  });

  test('says what may be typed in full', async () => {
    const room = await page.locator('#clash-search').evaluate((input) => {
      const style = getComputedStyle(input);
      const context = document.createElement('canvas').getContext('2d');
      context.font = style.font;
      // A search field keeps room for the cross that empties it.
      return input.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - 20 - context.measureText(input.placeholder).width;
    });
    assert.ok(room >= 0, `${room} pixels are left`);
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
    await page.selectOption('#filter-change', 'worse');
    await lists(isWorse);
    await clear();
    await page.click('.chip.resolved');
    assert.deepEqual(await listed(page), [ranked.length + 1, ranked.length + 2].map(String));
    await clear();
  });

  test('is filtered by what the files say of the parts', async () => {
    const says = (key, value) => (pair) =>
      [pair.a, pair.b].some((id) => [report.objects[id].properties[key]].flat().includes(value));
    for (const [key, value] of [
      ['GlobalId', '0guid$3'],
      ['Tag', 'T-4'],
      ['class', 'IfcPlate'],
      ['storey', 'Level 10'],
      ['material', 'mortar'],
    ]) {
      await page.fill('#clash-search', value.toLowerCase());
      await lists(says(key, value), `search for ${value}`);
      await clear();
    }
    for (const [key, values] of [
      ['class', ['IfcColumn', 'IfcFastener', 'IfcPlate']],
      ['storey', ['Level 2', 'Level 10']],
    ]) {
      const options = await page.locator(`#filter-${key} option`).allTextContents();
      assert.deepEqual(options, [`any ${key}`, ...values]);
      await page.selectOption(`#filter-${key}`, values[1]);
      await lists(says(key, values[1]), values[1]);
      await clear();
      assert.equal(await page.inputValue(`#filter-${key}`), '');
    }
  });

  test('is found by the axes of the grid', async () => {
    await page.fill('#clash-search', 'b/3');
    await lists((pair) => pair.axes === 'B/3');
    await clear();
    assert.deepEqual(await page.locator('#filter-axes option').allTextContents(), ['any axes', 'B/3', 'B/10']);
    await page.selectOption('#filter-axes', 'B/10');
    await lists((pair) => pair.axes === 'B/10');
    await clear();
  });

  test('is filtered by a part of the tree', async () => {
    const row = page.locator('#parts-tree .row', { hasText: 'far bolt' });
    await row.click();
    await page.getByRole('button', { name: 'Only its clashes' }).click();
    await lists((pair) => pair.a === 10 || pair.b === 10);
    await clear();
    await page.keyboard.press('Escape');
  });

  test('is counted in a matrix whose cells filter it', async () => {
    const failing = ranked.filter((pair) => pair.fails);
    for (const key of ['file', 'class', 'storey']) {
      await page.click('#matrix-button');
      await page.selectOption('#matrix-by', key);
      const cells = page.locator('#matrix td button');
      const counts = (await cells.allTextContents()).map(Number);
      assert.equal(counts.reduce((sum, count) => sum + count), failing.length, key);
      const last = cells.last();
      const [, ...found] = /^(?:both (.*)|(.*) × (.*)): \d+ pairs? fails?$/.exec(await last.getAttribute('title'));
      const values = [found[0] ?? found[1], found[0] ?? found[2]].sort();
      await last.click();
      assert.ok(await page.isHidden('#matrix'));
      const expected = failing.filter(({ a, b }) => [a, b].map((id) => traitOf(id, key)).sort().join() === values.join());
      assert.equal(expected.length, counts.at(-1));
      await lists((pair) => expected.includes(pair), `${key}: ${values}`);
      assert.equal(await page.getAttribute('.chip.failing', 'aria-pressed'), 'true');
      await clear();
    }
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

  test('is grouped by storey, class and file', async () => {
    for (const key of ['storey', 'class', 'file']) {
      const titleOf = ([p, q]) => (p === q ? `both ${p}` : `${p} × ${q}`);
      const orders = ({ a, b }) => [[a, b], [b, a]].map((ids) => titleOf(ids.map((id) => traitOf(id, key)))); // prettier-ignore
      await page.selectOption('#group', key);
      const titles = await listed(page, '.group-title .name');
      const ranks = await listed(page);
      let title;
      const found = new Map();
      titles.forEach((text, i) => text ? found.set((title = text), []) : found.get(title).push(ranks[i])); // prettier-ignore
      for (const [title, members] of found)
        assert.deepEqual(members, ranksOf((pair) => orders(pair).includes(title)), `${key}: ${title}`);
      assert.equal([...found.values()].flat().length, report.pairs.length);
    }
    await page.selectOption('#group', 'none');
  });

  test('is grouped in clusters by single linkage', async (t) => {
    const seed = 20250601;
    let state = seed;
    const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
    const blank = { ...report.pairs[0], id: undefined };
    const at = (centroid) => [{ ...report.pairs[0].regions[0], centroid }];
    // A duct through 40 studs, 0.4 apart and 400 from the rest, and 300 clashes of two parts anywhere in a box.
    const objects = Array.from({ length: 42 }, (_, id) => ({ ...report.objects[0], id, name: id ? `stud ${id}` : 'duct' }));
    const pairs = Array.from({ length: 40 }, (_, i) => ({ ...blank, a: 0, b: i + 1, regions: at([0.4 * i, 0, 400]) }));
    for (let i = 0; i < 300; ++i)
      pairs.push({ ...blank, a: 1, b: 41, regions: i % 50 ? at([20 * random(), 10 * random(), 10 * random()]) : [] });
    const page = await browser.visit(t, { report: { ...report, objects, pairs, resolved: [] } });
    await page.selectOption('#group', 'place');
    for (const link of [0.41, 0.8, 1.3, 30]) {
      await page.fill('#link', String(link));
      // Each takes in all that is near one of it, until nothing is.
      const clusters = [];
      const left = new Set(pairs);
      const distance = (p, q) => Math.hypot(...p.regions[0].centroid.map((c, k) => c - q.regions[0].centroid[k]));
      for (const first of left) {
        const cluster = [first];
        left.delete(first);
        for (const one of cluster)
          for (const other of left)
            if (one.regions.length && other.regions.length && distance(one, other) <= link) cluster.push(other), left.delete(other);
        clusters.push(cluster);
      }
      const rows = await listed(page, '.badge');
      const sizes = (counts) => counts.sort((x, y) => x - y).join();
      assert.equal(sizes(rows.map((count) => Number(count ?? 1))), sizes(clusters.map((one) => one.length)), `link ${link}, seed ${seed}`);
      assert.ok((await listed(page, '.group-title .name')).includes('duct × 40 parts'));
      if (link === 30) assert.ok((await listed(page, '.group-title .name')).includes('stud 1 × stud 41'), 'twice the same two');
    }
    await page.locator('.clash-group', { hasText: 'duct' }).click();
    assert.equal((await listed(page)).filter((rank) => rank !== null).length, 40 + 6);
  });

  test('shows all figures of a clash', async () => {
    const pair = report.pairs[0];
    await choose(rankOf(pair));
    const text = await page.textContent('#details-body');
    for (const figure of [
      '0.5072 to 0.5123',
      '0.4611 to 0.4867',
      '2.5',
      '12 crossing, 3 touching, 1 coplanar',
      '2 regions of contact',
      'a tolerance of 0.4867',
      'A is a solid, B is a solid',
      'IfcFastener · Level 10',
      'IfcPlate · Level 2',
      'GlobalId of A0guid$0',
      'Tag of BT-3',
      'Shape of B incomplete: its <b>lid</b> is left out.',
      'persisting, and worse: it was touching',
      '0000-0',
    ]) {
      assert.ok(text.includes(figure), `${figure} in ${text}`);
    }
    assert.equal(await page.locator('#details-body .number[title="0.51234567"]').count(), 1, 'all digits in the title');
    assert.match(await page.textContent('#live'), /^Clash \d+ of 14: bolt penetrates plate, depth 0.5123, volume 0.125\u00a0mm³$/);
    await page.locator('#details-body .part-link button').first().click();
    assert.match(await page.textContent('#details-body'), /materialbrick, mortar/);
    await choose(rankOf(report.pairs[1]));
    assert.match(await page.textContent('#details-body'), /Note: they overlap by no more than the tolerance\./);
    await page.keyboard.press('Escape');
    assert.ok(!page.url().includes('#'));
  });

  test('tells what is resolved', async () => {
    await choose(ranked.length + 1);
    assert.match(await page.textContent('#details-body'), /Changeresolved/);
    await page.keyboard.press('Escape');
    await page.click('.chip.resolved');
    assert.deepEqual(await listed(page, '.tag'), ['resolved', 'resolved']);
    await clear();
  });

  test('marks what got worse, and known clashes with a new region', async () => {
    const rows = await listed(page, '.tags');
    for (const [tag, isMarked, pair] of [
      ['worse', isWorse, report.pairs[0]],
      ['new region', (one) => changeOf(one) === 'new region', report.pairs[4]],
    ]) {
      assert.deepEqual(ranked.filter(isMarked), [pair]);
      assert.deepEqual(ranked.filter((_, i) => rows[i]?.includes(tag)), [pair]); // prettier-ignore
    }
    await choose(rankOf(report.pairs[4]));
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
      'tolerance-slider',
      'clash-list',
    ]) {
      assert.ok(reached.has(id), id);
    }
  });
});

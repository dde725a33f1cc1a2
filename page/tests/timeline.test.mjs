// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The motion of a mechanism. Where its parts are at a time is worked out here from how they move.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { listed, picture, settled, suiteBrowser } from './browser.mjs';
import { kMarkup, reviewPage } from './fixture.mjs';
import { mechanism, mechanismPage } from './mechanism.mjs';

const time = (page) => page.evaluate(() => window.impinge.store.state.time);
const pose = (page, id) => page.evaluate((id) => window.impinge.poseOf(id), id);
const seek = (page, time) => page.evaluate((time) => window.impinge.store.set({ time }), time);
const near = (x, y, what) => assert.ok(Math.abs(x - y) <= 1e-9 * Math.max(1, Math.abs(y)), `${what}: ${x}, not ${y}`);
const { motion } = mechanism();
const byTime = [2, 1, 0, 3].map((i) => motion.spans[i]);
/** How many pixels of the view are red, and of the colour in which a point of contact is drawn. */
async function coloured(page) {
  await settled(page);
  const { seen } = await picture(page);
  const counts = { reds: 0, dots: 0 };
  for (const [colour, count] of seen) {
    const [r, g] = [colour >> 16, (colour >> 8) & 255];
    if (colour === 0xc4005f) counts.dots += count;
    else if (r > 80 && r > 2 * g) counts.reds += count;
  }
  return counts;
}
const bar = (page, rank) => page.locator(`#timeline .span[data-rank="${rank}"]`);

describe('the timeline', () => {
  const browser = suiteBrowser(mechanismPage());

  test('parts stand at each time where they move to, and are seen there', async (t) => {
    const pictures = [];
    for (const offset of [
      [0, 0, 0],
      [2 ** 24, -(2 ** 25), 2 ** 23],
    ]) {
      const page = await browser.visit(t, mechanismPage({ offset }));
      for (const moment of [0, 0.5, 1, 1.3, 2.999, 3, 4]) {
        await seek(page, moment);
        const arm = await pose(page, 0);
        const [c, s] = [Math.cos((moment * Math.PI) / 2), Math.sin((moment * Math.PI) / 2)];
        [c, -s, 0, offset[0], s, c, 0, offset[1], 0, 0, 1, offset[2]].forEach((e, k) => near(arm[k], e, `arm at ${moment}`));
        near((await pose(page, 1))[3], offset[0] - 3 + 2 * moment, `slider at ${moment}`);
        // Not rigid: each number for itself.
        near((await pose(page, 3))[5], 1 + moment, `panel at ${moment}`);
      }
      assert.deepEqual((await pose(page, 2)).slice(3, 4), [4 + offset[0]], 'the wall stands still');
      await seek(page, 1.3);
      await settled(page);
      pictures.push((await picture(page)).png);
    }
    assert.ok(pictures[0].equals(pictures[1]), 'far from the origin the picture is as sharp as near it');
  });

  test('what moves far away is fitted and not cut off', async (t) => {
    const blocks = mechanism();
    blocks.motion.objects[1].poses.forEach((one, i) => (one[3] = -3 + 200 * i));
    const page = await browser.visit(t, blocks);
    await page.keyboard.press('f');
    await seek(page, 4);
    await page.evaluate(() => window.impinge.store.set({ part: 1 }));
    await settled(page);
    const { x, y } = await page.evaluate(() => window.impinge.screenPlace(1));
    const canvas = await page.locator('#canvas').boundingBox();
    assert.ok(x > canvas.x && x < canvas.x + canvas.width && y > canvas.y && y < canvas.y + canvas.height);
    // Seen from near and with the rest behind: the fit of it alone, then a click that hits it.
    await page.keyboard.press('f');
    await settled(page);
    await page.evaluate(() => window.impinge.store.set({ part: -1 }));
    const middle = await page.evaluate(() => window.impinge.screenPlace(1));
    await page.mouse.click(middle.x, middle.y);
    assert.equal(await page.evaluate(() => window.impinge.store.state.part), 1);
  });

  test('scrubs with the mouse, and the part is seen elsewhere', async () => {
    const page = await browser.take();
    const place = () => page.evaluate(() => window.impinge.screenPlace(1));
    const first = [await place(), (await picture(page)).png];
    const { x, y, width, height } = await page.locator('#time-slider').boundingBox();
    await page.mouse.move(x + width / 4, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2, y + height / 2, { steps: 3 });
    await page.mouse.up();
    await settled(page);
    assert.ok(Math.abs((await time(page)) - 2) < 0.02, 'half way');
    const then = [await place(), (await picture(page)).png];
    assert.ok(Math.hypot(then[0].x - first[0].x, then[0].y - first[0].y) > 20);
    assert.ok(!then[1].equals(first[1]));
    await page.mouse.move(x + width / 4, y + height / 2);
    assert.ok(Math.abs((await time(page)) - 2) < 0.02, 'what is let go of stays');
    // Beyond the ends it stays at the ends.
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width + 15, y + 200);
    assert.equal(await time(page), 4);
    await page.mouse.up();
    await page.waitForURL(/#t=4$/);
  });

  test('is gone through with keys', async () => {
    const page = await browser.take();
    const slider = page.locator('#time-slider');
    for (const focused of [false, true]) {
      if (focused) await slider.focus();
      for (const [key, goal] of [
        ['ArrowRight', 1],
        ['ArrowRight', 2],
        ['ArrowLeft', 1],
        ['End', 4],
        ['ArrowRight', 4],
        ['Home', 0],
        ['ArrowLeft', 0],
      ]) {
        await page.keyboard.press(key);
        assert.equal(await time(page), goal, key);
      }
    }
    await seek(page, 1.5);
    await page.keyboard.press('ArrowLeft');
    assert.equal(await time(page), 1, 'first to the frame before');
    await seek(page, 1.5);
    await page.keyboard.press('ArrowRight');
    assert.equal(await time(page), 2);
    assert.deepEqual(
      await slider.evaluate((one) =>
        ['role', 'aria-valuemin', 'aria-valuemax', 'aria-valuenow', 'aria-valuetext'].map((k) => one.getAttribute(k)),
      ),
      ['slider', '0', '4', '2', '2.000 s, no clash now'],
    );
  });

  test('plays, pauses and stops at the end', async () => {
    const page = await browser.take();
    assert.equal(await time(page), 0, 'nothing plays by itself');
    await page.keyboard.press(' ');
    await page.waitForFunction(() => window.impinge.store.state.time > 0.2);
    const { frames, x } = await page.evaluate(() => ({
      frames: window.impinge.frames(),
      x: window.impinge.poseOf(1)[3],
    }));
    await page.click('#play');
    const paused = await time(page);
    assert.match(await page.textContent('#live'), /^Paused at 0\.\d+ s|^Paused at [1-3]/);
    assert.ok(x > -3 && frames > 2);
    await settled(page);
    assert.equal(await time(page), paused);
    await page.selectOption('#speed', '4');
    await page.click('#play');
    await page.waitForFunction(() => window.impinge.store.state.time === 4);
    assert.equal(await page.textContent('#play'), 'Play');
    await page.check('#repeat');
    await page.click('#play');
    await page.waitForFunction(() => window.impinge.store.state.time > 3);
    await page.waitForFunction(() => window.impinge.store.state.time < 2);
    await page.click('#play');
  });

  test('nothing plays on after a clash is chosen', async () => {
    const page = await browser.take();
    await page.click('#play');
    await bar(page, 2).click();
    await settled(page);
    assert.equal(await time(page), byTime[1].from[1]);
  });

  test('lists every span in the order of time, and sorts and filters them', async () => {
    const page = await browser.take();
    const names = (spans) => spans.map(({ a, b }) => [a, b].map((id) => mechanism().report.objects[id].name));
    const rows = await listed(page, '.names');
    assert.equal(rows.length, motion.spans.length);
    names(byTime).forEach(([a, b], i) => assert.ok(rows[i].startsWith(a) && rows[i].endsWith(b), rows[i]));
    assert.deepEqual(await listed(page, '.side'), ['until 0.5 s', '1.25 to 1.75 s', '2.5 to 3.5 s', 'from 3.5 s on']);
    assert.equal(await page.locator('#timeline .span').count(), motion.spans.length);
    assert.equal(await page.locator('#timeline .lane').count(), 3, 'a lane for each pair');
    await page.selectOption('#sort', 'depth');
    assert.deepEqual(await listed(page), ['2', '3', '4', '1']);
    await page.selectOption('#sort', 'name');
    assert.deepEqual(await listed(page), ['1', '2', '4', '3']);
    await page.fill('#clash-search', 'wall');
    assert.deepEqual(await listed(page), ['3']);
    assert.equal(await page.locator('#timeline .span').count(), 1, 'the lanes follow the filter');
    await page.click('#clear-filters');
    await page.click('.chip.crossing');
    assert.deepEqual(await listed(page), ['1']);
  });

  test('is summed up with the limit of what it can see, and what it leaves out', async (t) => {
    const page = await browser.take();
    assert.match(await page.textContent('#verdict-line'), /^4 clashes in 4 s of motion/);
    const facts = await page.textContent('#facts');
    for (const fact of [
      'looked at 4 steps of 1 s, and between them along screws: a clash that is over within one step is missed only ' +
        'where its parts touch at both ends of the step, change their shape or move otherwise',
      '4 parts in 1 file, 3 of them moving',
      'deepest overlap 1.5',
      'animation run',
    ])
      assert.ok(facts.includes(fact), `${fact} in ${facts}`);
    const none = mechanism();
    none.motion.spans = [];
    none.motion.left_out = ['first', kMarkup, 'third', 'fourth', 'fifth', 'sixth'];
    const other = await browser.visit(t, none);
    assert.match(await other.textContent('#verdict-line'), /^No clash seen in 4 s of motion/);
    const told = await other.locator('#facts .left-out').allTextContents();
    assert.deepEqual(told, ['left out: first', `left out: ${kMarkup}`, 'left out: third', 'left out: 3 more things, which the JSON lists']);
    assert.equal(await other.locator('#facts b, #facts script').count(), 0, 'as text');
  });

  test('a click or Enter on a bar chooses the span: its start, its parts, its figures', async () => {
    const page = await browser.take();
    const before = (await picture(page)).png;
    await bar(page, 3).click();
    await settled(page);
    assert.equal(await time(page), motion.spans[0].from[1]);
    assert.equal(await page.textContent('#legend'), 'AsliderBwall');
    assert.equal(await page.getAttribute('#timeline .span[data-rank="3"]', 'aria-pressed'), 'true');
    assert.ok(!(await picture(page)).png.equals(before));
    const details = await page.textContent('#details-body');
    for (const text of [
      'Depth of A in B',
      'From2.5 s, within 3e−8 s',
      'To3.5 s, within 3e−8 s',
      'Lasts1 s',
      'Worst at3 s',
      'First contact3.75, 3, 0',
    ])
      assert.ok(details.includes(text), `${text} in ${details}`);
    await page.locator('#details-body button', { hasText: '3 s' }).last().click();
    assert.equal(await time(page), 3, 'the worst moment');
    await page.waitForURL(/#clash=3&t=3$/);
    await bar(page, 1).focus();
    await page.keyboard.press('Enter');
    assert.equal(await time(page), 0);
    assert.match(await page.textContent('#details-body'), /Fromthe first frame/);
    assert.equal(await page.locator('#details-body img').count(), 0, 'names are no markup');
    assert.ok((await page.textContent('#details-body')).includes(kMarkup));
    await page.waitForURL(/#clash=1$/);
    assert.match(await page.textContent('#live'), /^Clash 1 of 4: arm crosses .*until 0.5 s$/);
  });

  test('impacts are marks, of another shape where no frame shows them; keys go from one to the next', async () => {
    const page = await browser.take();
    const marks = await page.locator('.impact').evaluateAll((all) =>
      all.map((one) => [one.getAttribute('aria-label'), one.classList.contains('passage'), parseFloat(one.style.left)]),
    );
    assert.deepEqual(
      marks.map(([label]) => label),
      [
        '1.25 s: arm penetrates slider, between two frames only',
        '2.5 s: slider penetrates wall',
        '3.5 s: arm lies inside or around slider',
      ],
    );
    assert.deepEqual(marks.map(([, isPassage]) => isPassage), [true, false, false], 'a frame is at 3 and at 4');
    [1.25, 2.50000003, 3.5].forEach((t, i) => assert.ok(Math.abs(marks[i][2] - 25 * t) < 1e-4));
    assert.deepEqual(await page.locator('.span').evaluateAll((all) => all.map((one) => one.matches('.passage'))), [false, true, false, false]); // prettier-ignore
    assert.equal(await page.getAttribute('.impacts-field', 'role'), 'toolbar');
    assert.equal(await page.locator('.impact[tabindex="0"]').count(), 1, 'one stop of the Tab key');
    await page.focus('#time-slider');
    await page.keyboard.press('Tab');
    await page.keyboard.press('ArrowRight');
    assert.equal(await time(page), 0, 'arrow keys go to a mark, and not to a frame');
    await page.keyboard.press('Enter');
    await settled(page);
    assert.equal(await time(page), motion.spans[0].from[1]);
    assert.equal(await page.textContent('#legend'), 'AsliderBwall');
    assert.equal(await page.locator('.impact[aria-pressed=true]').getAttribute('aria-label'), marks[1][0]);
    assert.ok((await coloured(page)).dots > 8, 'the point of contact is drawn');
    await page.keyboard.press('Home');
    await page.keyboard.press('Enter');
    await settled(page);
    assert.equal(await time(page), motion.spans[1].from[1]);
    assert.match(await page.textContent('#live'), /1.25 to 1.75 s, between two frames$/);
    assert.match(await page.textContent('#details-body'), /Seenbetween two frames only/);
    assert.equal((await coloured(page)).dots, 0, 'of this one no point is known');
    await page.fill('#clash-search', 'wall');
    assert.equal(await page.locator('.impact').count(), 1, 'they follow the filter');
  });

  test('a link opens its clash at its time', async (t) => {
    const page = await browser.visit(t, mechanismPage(), { hash: '#clash=3&t=3.25' });
    for (const [hash, goal, legend] of [
      ['#clash=3&t=3.25', 3.25, 'AsliderBwall'],
      ['#t=2.25', 2.25, ''],
      ['#clash=3', motion.spans[0].from[1], 'AsliderBwall'],
      ['#t=99', 4, ''],
      ['#t=soon', 0, ''],
      ['#clash=%', 0, ''],
    ]) {
      if (!page.url().endsWith(hash)) await page.evaluate((hash) => (location.hash = hash), hash);
      await settled(page);
      assert.equal(await time(page), goal, hash);
      assert.equal(await page.locator('#legend').isVisible(), legend !== '', hash);
      if (legend) assert.equal(await page.textContent('#legend'), legend);
      near((await pose(page, 1))[3], -3 + 2 * goal, hash);
      await page.evaluate(() => window.impinge.store.set({ clash: null, time: 0 }));
    }
  });

  test('what clashes at a time is seen by its colour', async (t) => {
    const page = await browser.take();
    assert.equal(await page.textContent('.time-now'), '1 clash now');
    await seek(page, 2);
    assert.equal(await page.textContent('.time-now'), 'no clash now');
    assert.equal((await coloured(page)).reds, 0);
    await seek(page, 3);
    assert.ok((await coloured(page)).reds > 500);
    // Where nothing clashes in the beginning, nothing is red before a time is chosen.
    const calm = mechanism();
    calm.motion.spans = calm.motion.spans.filter((span) => span.from);
    const other = await browser.visit(t, calm);
    assert.equal(await other.textContent('.time-now'), 'no clash now');
    assert.equal((await coloured(other)).reds, 0);
    await seek(other, 3);
    assert.ok((await coloured(other)).reds > 500);
  });

  test('the tree counts in red what clashes at some time', async () => {
    const page = await browser.take();
    const red = await page.evaluate(() =>
      [...document.querySelectorAll('#parts-tree .row:has(.badge.failing)')].map((row) => [
        row.querySelector('.name').textContent,
        row.querySelector('.badge').textContent,
      ]),
    );
    assert.deepEqual(red, [
      ['arm', '3'],
      ['slider', '3'],
      ['wall', '1'],
      [kMarkup, '1'],
    ]);
  });

  test('many pairs: lanes that scroll, of which few are in the document', async (t) => {
    const page = await browser.visit(t, mechanismPage({ lanes: 600 }));
    assert.ok((await page.locator('#timeline .lane').count()) < 30);
    await page.evaluate(() => window.impinge.store.select(window.impinge.clashes.at(-1)));
    await settled(page);
    const last = page.locator('#timeline .span[aria-pressed=true]');
    const [inner, outer] = [await last.boundingBox(), await page.locator('#tracks').boundingBox()];
    assert.ok(inner.y >= outer.y && inner.y + inner.height <= outer.y + outer.height, 'the chosen one is in sight');
    const head = await page.locator('.playhead').boundingBox();
    assert.ok(head.y + head.height >= outer.y + outer.height - 12, 'the head reaches down to it');
    // Marks that would lie on each other are one, which clicks go through.
    const mark = page.locator('.impact[aria-label*="again for the next one"]').first();
    const impacts = Number((await mark.getAttribute('aria-label')).match(/: (\d+) impacts/)[1]);
    assert.ok(impacts > 2 && (await page.locator('.impact').count()) < 200);
    const ranks = [];
    for (let i = 0; i <= impacts; ++i) {
      await mark.click();
      ranks.push(await page.evaluate(() => window.impinge.store.state.clash.rank));
    }
    assert.equal(new Set(ranks).size, impacts);
    assert.equal(ranks[impacts], ranks[0]);
  });

  test('nothing stands out of a narrow window, where a finger scrubs', async (t) => {
    for (const width of [320, 390]) {
      const page = await browser.visit(t, mechanismPage({ lanes: 5 }), { width, height: 640, touch: true });
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      await bar(page, 2).click();
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      const track = await page.locator('#time-slider').boundingBox();
      await page.touchscreen.tap(track.x + track.width * 0.75, track.y + track.height / 2);
      assert.ok(Math.abs((await time(page)) - 3) < 0.03, 'scrubs with a finger');
    }
  });

  test('works without a 3D view, and other pages have no timeline', async (t) => {
    const { scene, geometry, ...rest } = mechanism();
    const page = await browser.visit(t, rest);
    await page.keyboard.press('End');
    assert.equal(await time(page), 4);
    const other = await browser.visit(t, reviewPage());
    assert.ok(await other.locator('#timeline').isHidden());
  });

  test('a motion that cannot be read is told, and the parts are shown', async (t) => {
    const blocks = mechanism();
    blocks.motion.times = [];
    const page = await browser.visit(t, blocks);
    assert.match(await page.textContent('#trouble'), /^The motion cannot be read: it lists no times/);
    assert.ok(await page.locator('#timeline').isHidden());
    assert.ok((await picture(page)).count > 10);
  });
});

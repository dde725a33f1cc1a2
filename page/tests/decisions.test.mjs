// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Decisions that are made on the page, from there to the command line and back. IMPINGE names the program, if it is not the
// one of the release build.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { listed, suiteBrowser } from './browser.mjs';
import { compose } from './compose.mjs';
import { review, reviewPage } from './fixture.mjs';

const impinge = process.env.IMPINGE ?? fileURLToPath(new URL('../../build/release/cli/impinge', import.meta.url));
const template = fileURLToPath(new URL('../../build/page/report.html', import.meta.url));
const kComment = 'first <b>line</b>\n"second" \u{1F527} line';

/** A box from its least corner, 2 along each side. */
const off = ([x, y, z]) => {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [x + 2 * (i & 1), y + (i & 2), z + ((i & 4) >> 1)].join(' '));
  const faces = ['0 2 3 1', '4 5 7 6', '0 1 5 4', '2 6 7 3', '0 4 6 2', '1 3 7 5'].map((face) => `4 ${face}`);
  return ['OFF', '8 6 0', ...corners, ...faces, ''].join('\n');
};

describe('decisions', () => {
  const browser = suiteBrowser();

  const choose = (page, rank) => page.locator('#clash-list .row', { has: page.locator('.names') }).nth(rank - 1).click();
  const decide = async (page, { status, assignee, due, comment }) => {
    if (status !== undefined) await page.selectOption('#decided-status', status);
    if (assignee !== undefined) await page.fill('#decided-assignee', assignee);
    if (due !== undefined) await page.fill('#decided-due', due);
    if (comment !== undefined) await page.fill('#decided-comment', comment);
  };
  const decided = async (page) => ({
    status: await page.inputValue('#decided-status'),
    assignee: await page.inputValue('#decided-assignee'),
    due: await page.inputValue('#decided-due'),
    comment: await page.inputValue('#decided-comment'),
  });
  const unsaved = (page) => page.isVisible('#save-decisions');
  const saved = async (page) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-decisions')]);
    assert.equal(download.suggestedFilename(), 'decisions.json');
    return readFileSync(await download.path(), 'utf8');
  };

  test('go from the page to --decisions and back', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'impinge-decisions-'));
    try {
      for (const [name, corner] of Object.entries({ left: [0, 0, 0], middle: [1, 1, 1], right: [1.5, 2, 2] }))
        writeFileSync(join(folder, `${name}.off`), off(corner));
      const clash = (...more) => {
        const words = ['clash', 'left.off', 'middle.off', 'right.off', '--html', 'out.html', '--quiet', ...more];
        const { status, stderr } = spawnSync(impinge, words, { cwd: folder, env: { ...process.env, IMPINGE_PAGE: template } });
        assert.equal(status, 1, String(stderr));
        return readFileSync(join(folder, 'out.html'), 'utf8');
      };
      const first = await browser.open(clash());
      assert.ok(!(await unsaved(first.page)), 'there is nothing to save');
      await choose(first.page, 1);
      const made = { status: 'reviewed', assignee: 'Ann Ü', due: '2024-06-14', comment: kComment };
      await decide(first.page, made);
      await choose(first.page, 2);
      await decide(first.page, { status: 'open' });
      assert.deepEqual(await listed(first.page, '.tags'), ['reviewed', 'open', null]);
      const ids = await first.page.evaluate(() => window.impinge.clashes.map(({ pair }) => pair.id));
      const file = await saved(first.page);
      assert.deepEqual(JSON.parse(file), {
        $schema: 'decisions.schema.json',
        [ids[0]]: made,
        [ids[1]]: { status: 'open' },
      });
      await first.close();

      // People wrote more into it: about one pair by names of its parts, and about a pair that is gone.
      const more = { 'right | le?t': { assignee: 'Bob' }, 'left | gone': { status: 'resolved' } };
      writeFileSync(join(folder, 'decisions.json'), JSON.stringify({ ...more, ...JSON.parse(file) }));
      const second = await browser.open(clash('--decisions', 'decisions.json'));
      assert.deepEqual(await listed(second.page, '.tags'), ['reviewed', 'open', null]);
      await choose(second.page, 1);
      assert.deepEqual(await decided(second.page), made);
      assert.ok(!(await unsaved(second.page)), 'nothing is changed');
      await second.page.selectOption('#filter-assignee', 'Ann Ü');
      assert.equal(await second.page.textContent('#clashes-count'), '1 of 3');
      // What came with the report is saved with what is new, and what was taken back stays so.
      await decide(second.page, { status: '', assignee: '', due: '', comment: '' });
      await second.page.click('#clear-filters');
      await choose(second.page, 3);
      await decide(second.page, { comment: 'new' });
      assert.deepEqual(JSON.parse(await saved(second.page)), {
        $schema: 'decisions.schema.json',
        ...more,
        [ids[0]]: {},
        [ids[1]]: { status: 'open' },
        [ids[2]]: { assignee: 'Bob', comment: 'new' },
      });
      await second.close();
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

  test('are kept until the page is opened again, and of this report alone', async (t) => {
    const page = await browser.visit(t, reviewPage());
    await choose(page, 2);
    await decide(page, { status: 'active', comment: kComment });
    await page.reload();
    await choose(page, 2);
    assert.deepEqual(await decided(page), { status: 'active', assignee: '', due: '', comment: kComment });
    assert.ok(await unsaved(page));
    const { report, ...rest } = review();
    report.pairs[0].status = 'other';
    const file = fileURLToPath(page.url().split('#')[0]);
    writeFileSync(file, compose({ report, ...rest }));
    await page.reload();
    assert.ok(!(await unsaved(page)), 'another report has decisions of its own');
    writeFileSync(file, reviewPage());
    await page.reload();
    await choose(page, 2);
    const keys = await page.evaluate(() => Object.keys(localStorage));
    assert.equal(keys.length, 1);
    await decide(page, { status: '', comment: '' });
    assert.deepEqual(await page.evaluate(() => Object.keys(localStorage)), [], 'it is as in the report again');
    for (const kept of ['{', 'null', '7', '{"0000-0":7,"0000-1":{"status":{}}}']) {
      await page.evaluate(([key, kept]) => localStorage.setItem(key, kept), [keys[0], kept]);
      await page.reload();
      assert.deepEqual((await listed(page, '.tags')).filter((tags) => /active/.test(tags)), [], kept);
    }
    await page.context().addInitScript(() =>
      Object.defineProperty(window, 'localStorage', { get: () => { throw new Error('forbidden'); } }), // prettier-ignore
    );
    await page.reload();
    await choose(page, 2);
    await decide(page, { status: 'active' });
    assert.equal((await listed(page, '.tags')).filter((tags) => /active/.test(tags)).length, 1);
  });

  test('are made for all of a group, or of a list that is filtered', async (t) => {
    const page = await browser.visit(t, reviewPage());
    page.on('dialog', (dialog) => dialog.accept());
    const { report } = review();
    const count = (key, value) =>
      page.evaluate(([key, value]) => window.impinge.clashes.filter(({ pair }) => pair?.[key] === value).length, [key, value]);
    await page.selectOption('#group', 'file');
    await page.locator('#clash-list .clash').first().click();
    await decide(page, { status: 'active', assignee: 'Ann' });
    const title = await page.locator('.group-title .name').first().textContent();
    const [p, q] = /^both (.*)$/.test(title) ? [title.slice(5), title.slice(5)] : title.split(' × ');
    const filesOf = ({ a, b }) => [report.objects[a].file, report.objects[b].file].sort().join();
    const members = report.pairs.filter((pair) => filesOf(pair) === [p, q].sort().join());
    assert.equal(await page.textContent('#decide-all'), `Same for all ${members.length} of the group`);
    await page.click('#decide-all');
    assert.equal(await count('status', 'active'), members.length);
    await page.selectOption('#group', 'none');
    await page.click('.chip.touching');
    await page.locator('#clash-list .clash').first().click();
    await decide(page, { status: '', assignee: 'Bob', comment: '' });
    assert.equal(await page.textContent('#decide-all'), 'Same for all 3 of the list');
    await page.click('#decide-all');
    assert.equal(await count('assignee', 'Bob'), 3);
    const { a, b } = await page.evaluate(() => window.impinge.store.state.clash.pair);
    const wasActive = members.some((pair) => pair.a === a && pair.b === b);
    assert.equal(await count('status', 'active'), members.length - wasActive, 'a status that is not said is kept');
    await page.click('#clear-filters');
    assert.ok(await page.isHidden('#decide-all'), 'not for all there are');
  });

  test('show what people wrote as they wrote it', async (t) => {
    const page = await browser.visit(t, reviewPage());
    const rank = await page.evaluate(() => window.impinge.clashes.find(({ pair }) => pair?.comment).rank);
    await choose(page, rank);
    const text = 'seen by <b>two</b>\nnot by\u202e three\nor four';
    assert.deepEqual(await decided(page), { status: 'approved', assignee: '', due: '', comment: text });
    await page.focus('#decided-comment');
    await page.keyboard.type('j?');
    assert.equal(await page.inputValue('#decided-comment'), `${text}j?`, 'keys in a field are text');
  });
});

// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The tree of parts.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { listed, suiteBrowser } from './browser.mjs';
import { review, reviewPage } from './fixture.mjs';

const { report, scene, geometry } = review();

describe('the tree of parts', () => {
  const browser = suiteBrowser(reviewPage());

  test('lists files, groups and parts; search leaves what matches and the way to it', async () => {
    const page = await browser.take();
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
  });

  test('has the groups of the scene, whatever parts and groups are called', async (t) => {
    const [file, mesh] = ['a.glb', scene.meshes.length - 1];
    const named = [
      ['bolt', 'root/bolt', 0],
      ['bolt (2)', 'root/bolt', 0],
      ['DN 1/2', 'DN 1/2'],
      ['DN 1/2 (2)', 'root/asm/DN 1/2', 1],
      ['nut', 'root/asm/nut', 2],
      ['pin', 'root/a/b/pin', 3],
      ['washer', 'root/asm/washer', 1],
    ];
    const groups = [
      { name: 'root' },
      { name: 'asm', parent: 0 },
      { name: 'asm', parent: 0 },
      { name: 'a/b', parent: 0 },
    ];
    const objects = named.map(([name, path], id) => ({ ...report.objects[0], id, name, path, file }));
    const placed = named.map(([, , group], i) => ({ mesh, pose: scene.objects[i].pose, group }));
    const page = await browser.visit(t, {
      report: { ...report, objects, pairs: [], resolved: [] },
      scene: { ...scene, groups, objects: placed },
      geometry,
    });
    const rows = await page.evaluate(() =>
      [...document.querySelectorAll('#parts-tree .row')].map(
        (row) => `${row.getAttribute('aria-level')} ${row.querySelector('.name').textContent}`,
      ),
    );
    assert.deepEqual(rows, [
      '1 a.glb',
      '2 root',
      '3 bolt',
      '3 bolt (2)',
      '3 asm',
      '4 DN 1/2 (2)',
      '4 washer',
      '3 asm',
      '4 nut',
      '3 a/b',
      '4 pin',
      '2 DN 1/2',
    ]);
  });

  test('finds the parts of what is resolved, which may share a path', async (t) => {
    const gone = (place) => ({ ...report.resolved[0], a: place, b: { name: 'gone', path: 'gone', file: place.file } });
    const objects = report.objects.map((part, id) => (id < 2 ? { ...part, path: 'frame/left/bolt' } : part));
    const resolved = [
      ...objects.slice(0, 3),
      { ...objects[2], name: 'bolt (9)' }, // numbered otherwise, but alone with its path
      { ...objects[0], name: 'bolt (9)' }, // two have its path
    ].map(gone);
    const page = await browser.visit(t, { report: { ...report, objects, resolved } });
    const found = await page.evaluate(() =>
      window.impinge.clashes.filter((one) => one.resolved).map((one) => one.first),
    );
    assert.deepEqual(found, [0, 1, 2, 2, -1]);
  });

  test('counts in red what fails, and nothing else', async (t) => {
    const nothing = report.pairs.map((pair) => ({ ...pair, fails: false }));
    for (const pairs of [report.pairs, nothing]) {
      const page = await browser.visit(t, { report: { ...report, pairs } }, { height: 1600 });
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
    }
  });

  test('hides, isolates and shows', async () => {
    const page = await browser.take();
    await page.focus('#parts-tree');
    await page.keyboard.press('Home');
    await page.keyboard.press('h');
    assert.equal(await page.textContent('#parts-count'), '12, 6 hidden');
    await page.keyboard.press('i');
    assert.equal(await page.textContent('#parts-count'), '12, 6 hidden');
    await page.click('#show-all');
    assert.equal(await page.textContent('#parts-count'), '12');
  });
});

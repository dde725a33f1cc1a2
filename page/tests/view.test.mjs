// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The 3D view: what is seen changes with what is chosen, and what is clicked is chosen.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { listed, picture, settled, suiteBrowser } from './browser.mjs';
import { nestedPage, plantPage, review, reviewPage, twinsPage } from './fixture.mjs';

const stand = (page) => page.evaluate(() => structuredClone(window.impinge.stand()));
const frames = (page) => page.evaluate(() => window.impinge.frames());
/** Fails, when it is called, unless the picture is another one than at its last call, or when it was made. */
async function watched(page) {
  let last = (await picture(page)).png;
  return async (what) => {
    await settled(page);
    const { png } = await picture(page);
    assert.ok(!png.equals(last), what);
    last = png;
  };
}

describe('the 3D view', () => {
  const browser = suiteBrowser(reviewPage());

  test('is not blank, light and dark', async () => {
    const page = await browser.take();
    for (const scheme of ['light', 'dark']) {
      await page.emulateMedia({ colorScheme: scheme });
      await settled(page);
      const { count, most } = await picture(page);
      assert.ok(count > 50 && most < 0.97, `${count} colours, ${most} of it is one`);
    }
    await page.emulateMedia({ colorScheme: 'light' });
  });

  test('stands on what the scene says is down, whatever the files are called', async (t) => {
    for (const [up, file] of [
      ['y', 'house.ifc'],
      ['z', 'house.glb'],
    ]) {
      const { report, scene, geometry } = review();
      for (const part of report.objects) part.file = file;
      const page = await browser.visit(t, { report, scene: { ...scene, up }, geometry });
      assert.equal(await page.inputValue('#up-axis'), up);
      const labels = await page.locator('#cube button').evaluateAll((all) => all.map((one) => one.ariaLabel));
      const axes = { y: ['+Z', '+Y'], z: ['−Y', '+Z'] }[up];
      ['front', 'top'].forEach((face, i) => assert.ok(labels.includes(`View from the ${face} (${axes[i]})`), labels.join()));
      // From the front, upwards on the screen is along that axis; from the top, nothing is.
      const k = up === 'y' ? 1 : 2;
      const rise = async (key) => {
        await page.keyboard.press(key);
        await settled(page);
        const places = [0, 10].map((id) => scene.objects[id].pose.filter((_, i) => i % 4 === 3)[k]);
        const seen = await page.evaluate(() => [0, 10].map((id) => window.impinge.screenPlace(id).y));
        return (seen[0] - seen[1]) / (places[1] - places[0]);
      };
      assert.ok((await rise('1')) > 20);
      const turned = await page.evaluate(() => window.impinge.stand());
      assert.ok(Math.abs(turned.yaw) < 1e-9 && Math.abs(turned.pitch) < 1e-9);
    }
  });

  test('of two equal parts in one place the first is seen, from everywhere', async (t) => {
    const page = await browser.visit(t, twinsPage(), { hash: '#clash=1' });
    for (const isParallel of [false, true]) {
      if (isParallel) await page.keyboard.press('p');
      for (const key of ['', 'ArrowLeft', 'ArrowUp', 'ArrowLeft', 'ArrowRight', 'ArrowDown', 'ArrowDown']) {
        if (key) await page.keyboard.press(key);
        await settled(page);
        const { a, b } = await picture(page);
        assert.ok(a > 0.05 && b < 0.002, `${key}: ${a} of it is the first, ${b} the second`);
      }
    }
  });

  test('a click in the list moves the camera, fills the details and marks the parts', async () => {
    const page = await browser.take();
    const before = [await stand(page), await picture(page)];
    await page.locator('#clash-list .row').nth(2).click();
    await settled(page);
    const after = [await stand(page), await picture(page)];
    assert.notDeepEqual(after[0].target, before[0].target);
    assert.ok(after[0].distance < before[0].distance);
    assert.ok(!after[1].png.equals(before[1].png));
    assert.match(await page.textContent('#details-body'), /AxesB\/3, Level 2Depth of A in B.*Volume in common0\.0625 ± 1e−10\u00a0mm³/);
    assert.equal(await page.textContent('#legend'), 'Abolt (2)Bplate');
    // The camera looks at the contact.
    const { report } = review();
    const deepest = report.pairs.find((pair) => pair.a === 1 && pair.b === 3).regions[0].centroid;
    after[0].target.forEach((c, k) => assert.ok(Math.abs(c - deepest[k]) < 1e-9));
    await page.keyboard.press('Escape');
    assert.ok(await page.locator('#legend').isHidden());
  });

  test('a flight ends where the jump ends', async (t) => {
    const still = await browser.take();
    await still.locator('#clash-list .row').nth(3).click();
    const end = await stand(still);
    const page = await browser.visit(t, reviewPage(), { motion: 'no-preference' });
    const start = await stand(page);
    await page.locator('#clash-list .row').nth(3).click();
    assert.ok((await stand(page)).distance > end.distance + 1e-6, 'it is on its way');
    await page.waitForFunction(
      ({ distance }) => Math.abs(window.impinge.stand().distance - distance) < 1e-6,
      end,
    );
    const landed = await stand(page);
    for (const key of ['yaw', 'pitch']) assert.ok(Math.abs(end[key] - landed[key]) < 1e-6, key);
    assert.notEqual(landed.distance, start.distance);
  });

  test('a link opens its clash, by number and by id', async (t) => {
    const page = await browser.visit(t, reviewPage(), { hash: '#clash=3' });
    for (const hash of ['#clash=3', '#clash=0000-2']) {
      await page.evaluate((hash) => (location.hash = hash), hash);
      await settled(page);
      assert.ok(page.url().endsWith('#clash=3'));
      assert.equal(await page.textContent('#legend'), 'Abolt (2)Bplate');
      await page.keyboard.press('Escape');
    }
  });

  test('a click on a part selects it in the tree', async (t) => {
    const page = await browser.visit(t, reviewPage(), { height: 560 });
    for (const id of [5, 10]) {
      const { x, y } = await page.evaluate((part) => window.impinge.screenPlace(part), id);
      await page.mouse.click(x, y);
      const row = page.locator('#parts-tree .row[aria-selected=true]');
      assert.equal(await row.locator('.name').textContent(), ['post', 'far bolt'][Number(id === 10)]);
    }
    await settled(page);
    const inSight = await page.evaluate(() => {
      const [row, list] = ['#parts-tree [aria-selected=true]', '#parts-tree'].map((one) =>
        document.querySelector(one).getBoundingClientRect(),
      );
      return row.top >= list.top && row.bottom <= list.bottom + 1;
    });
    assert.ok(inSight, 'the row is in sight');
    await page.keyboard.press('h');
    await settled(page);
    const { x, y } = await page.evaluate(() => window.impinge.screenPlace(10));
    await page.keyboard.press('Escape');
    await page.mouse.click(x, y);
    assert.equal(
      await page.locator('#parts-tree .row[aria-selected=true] .name', { hasText: 'far bolt' }).count(),
      0,
      'what is hidden is not hit',
    );
  });

  test('hiding, isolating, colours and fading change what is seen', async () => {
    const page = await browser.take();
    const differs = await watched(page);
    for (const [what, act] of Object.entries({
      'two are hidden': () => page.evaluate(() => window.impinge.store.set({ hidden: new Set([3, 4]) })),
      'two are left': () => page.evaluate(() => window.impinge.store.isolate([0, 5])),
      'all are there': () => page.keyboard.press('a'),
      'by verdict': () => page.evaluate(() => window.impinge.store.set({ colourBy: 'verdict' })),
      'by file': () => page.evaluate(() => window.impinge.store.set({ colourBy: 'file' })),
      'a clash': () => page.evaluate(() => window.impinge.store.select(window.impinge.clashes[2])),
      'through both parts': () => page.keyboard.press('x'),
      'boxes of regions': () => page.keyboard.press('b'),
      'the others are gone': () => page.evaluate(() => window.impinge.store.set({ others: 'hide' })),
    })) {
      await act();
      await differs(what);
    }
  });

  test('sections, explosion and views change what is seen, and can be undone', async () => {
    const page = await browser.take();
    const whole = (await picture(page)).png;
    let differs = await watched(page);
    await page.keyboard.press('s');
    for (const axis of ['x', 'y', 'z']) {
      await page.click(`[data-axis=${axis}]`);
      await differs(`section ${axis}`);
    }
    await page.fill('#section-place', '250');
    await differs('section moved');
    await page.click('#section-flip');
    await differs('section flipped');
    assert.ok(await page.locator('[data-axis=clash]').isDisabled(), 'no clash is chosen');
    await page.click('[data-axis=none]');
    await page.keyboard.press('Escape');
    await page.keyboard.press('e');
    await page.fill('#explode-by', '100');
    await differs('explosion');
    await page.fill('#explode-by', '0');
    await page.keyboard.press('Escape');
    await page.evaluate(() => document.activeElement.blur());
    await settled(page);
    assert.ok((await picture(page)).png.equals(whole), 'all is as it was');
    for (const key of ['1', '5', 'p']) {
      await page.keyboard.press(key);
      await differs(`key ${key}`);
    }
    await page.evaluate(() => window.impinge.store.select(window.impinge.clashes[2]));
    await page.keyboard.press('s');
    await settled(page);
    differs = await watched(page);
    await page.click('[data-axis=clash]');
    await differs('through the clash');
    await page.click('[data-axis=none]');
    await page.keyboard.press('Escape');
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press('p');
  });

  test('what a section cuts away is not hit', async () => {
    const page = await browser.take();
    const hit = async (id) => {
      const { x, y } = await page.evaluate((part) => window.impinge.screenPlace(part), id);
      await page.evaluate(() => window.impinge.store.set({ part: -1 }));
      await page.mouse.click(x, y);
      return (await page.evaluate(() => window.impinge.store.state.part)) === id;
    };
    // The plane is at x = 3.3 or so: the post stands before it, the far bolt behind.
    await page.keyboard.press('s');
    await page.click('[data-axis=x]');
    assert.deepEqual([await hit(5), await hit(10)], [true, false]);
    await page.click('#section-flip');
    assert.deepEqual([await hit(5), await hit(10)], [false, true]);
    await page.click('[data-axis=none]');
    assert.deepEqual([await hit(5), await hit(10)], [true, true]);
    await page.keyboard.press('Escape');
  });

  test('is turned, moved and zoomed by mouse, wheel, keys and the cube', async () => {
    const page = await browser.take();
    const box = await page.locator('#canvas').boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 3];
    let last = await stand(page);
    const moved = async (keys, what) => {
      await settled(page);
      const now = await stand(page);
      for (const key of ['yaw', 'pitch', 'distance', 'target']) {
        const equal = JSON.stringify(now[key]) === JSON.stringify(last[key]);
        assert.equal(equal, !keys.includes(key), `${what}: ${key}`);
      }
      last = now;
    };
    const drag = async (button, shift) => {
      if (shift) await page.keyboard.down('Shift');
      await page.mouse.move(x, y);
      await page.mouse.down({ button });
      await page.mouse.move(x + 40, y + 25, { steps: 3 });
      await page.mouse.up({ button });
      if (shift) await page.keyboard.up('Shift');
    };
    await drag('left');
    await moved(['yaw', 'pitch'], 'drag');
    await drag('right');
    await moved(['target'], 'right drag');
    await drag('left', true);
    await moved(['target'], 'shift drag');
    await page.mouse.move(x + 50, y);
    await page.mouse.wheel(0, -240);
    await moved(['distance', 'target'], 'wheel');
    await page.focus('#canvas');
    await page.keyboard.press('ArrowLeft');
    await moved(['yaw'], 'arrow');
    await page.keyboard.press('Shift+ArrowUp');
    await moved(['target'], 'shift arrow');
    await page.keyboard.press('+');
    await moved(['distance'], 'plus');
    await page.getByRole('button', { name: /View from the top/ }).press('Enter');
    await moved(['yaw', 'pitch'], 'cube');
  });

  test('what hides a part of the chosen clash is seen through, and the control stays as it is', async (t) => {
    const page = await browser.visit(t, nestedPage());
    for (const scheme of ['light', 'dark']) {
      await page.emulateMedia({ colorScheme: scheme });
      const shown = async (what) => {
        const index = ['inside', 'flush', 'poking', 'through', 'around'].indexOf(what);
        await page.evaluate((i) => {
          const { store, clashes } = window.impinge;
          store.select(clashes.find((clash) => clash.pair.id === `pair ${i}`));
        }, index);
        await settled(page);
        return picture(page);
      };
      for (const what of ['inside', 'flush']) {
        const { a, b } = await shown(what);
        assert.ok(a > 0.005 && b < 0.02, `${what}, ${scheme}: the inner part stands first; ${a}, ${b}`);
      }
      const poking = await shown('poking');
      assert.ok(poking.a > 0.05 && poking.b < 0.02, `poking, ${scheme}: ${poking.a}, ${poking.b}`);
      const around = await shown('around');
      assert.ok(around.b > 0.05 && around.a < 0.02, `around, ${scheme}: ${around.a}, ${around.b}`);
      const through = await shown('through');
      assert.ok(through.a > 0.005 && through.b > 0.05, `through, ${scheme}: ${through.a}, ${through.b}`);
      assert.equal(await page.isChecked('#glass'), false);
      await page.keyboard.press('x');
      await shown('inside');
      const back = await shown('through');
      assert.ok(back.b < through.b / 2, `the user sees through both: ${back.a}, ${back.b} after ${through.a}, ${through.b}`);
      assert.equal(await page.isChecked('#glass'), true);
      await page.keyboard.press('x');
    }
  });

  test('draws only when something changed', async () => {
    const page = await browser.take();
    await settled(page);
    const count = await frames(page);
    for (let i = 0; i < 5; ++i) await settled(page);
    assert.equal(await frames(page), count);
    await page.selectOption('#sort', 'name');
    await page.selectOption('#group', 'part');
    await page.fill('#clash-search', 'bolt');
    await page.click('.chip.failing');
    await settled(page);
    assert.equal(await frames(page), count, 'the list alone changed');
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press('1');
    await settled(page);
    assert.ok((await frames(page)) > count);
    await page.click('#clear-filters');
  });

  test('is the same far from the origin', async (t) => {
    const pictures = [];
    for (const offset of [
      [0, 0, 0],
      [8388608, -4194304, 16777216],
    ]) {
      const page = await browser.visit(t, reviewPage({ offset }), { hash: '#clash=4' });
      pictures.push((await picture(page)).png);
    }
    assert.ok(pictures[0].equals(pictures[1]), 'powers of two move nothing by a rounding');
  });

  test('copes with parts that are flat, mirrored, empty or nowhere', async (t) => {
    const { report, scene, geometry } = review();
    const poses = structuredClone(scene);
    poses.objects[0].pose.fill(0, 0, 3);
    poses.objects[1].pose[0] = -1;
    poses.objects[2].pose = new Array(12).fill(0);
    poses.objects[5].pose[3] = 1e300;
    const page = await browser.visit(t, { report, scene: poses, geometry }, { hash: '#clash=1' });
    assert.equal((await listed(page)).length, report.pairs.length);
    await page.keyboard.press('f');
    await page.keyboard.press('j');
  });

  test('shows a report of no parts', async (t) => {
    const { report } = review({ triage: false });
    const none = { ...report, objects: [], pairs: [], counts: { ...report.counts, fail: 0 } };
    const scene = { version: 1, title: 'none', triangles: 0, shown: 0, meshes: [], objects: [] };
    const page = await browser.visit(t, { report: none, scene, geometry: 'eJwDAAAAAAE=' });
    assert.match(await page.textContent('#verdict-line'), /Nothing fails/);
    await page.keyboard.press('f');
  });

  test('10,000 parts open, and a click selects', async (t) => {
    const page = await browser.visit(t, plantPage(), { width: 1000, height: 640 });
    assert.equal(await page.getAttribute('#clash-list', 'aria-rowcount'), '15000');
    const { count } = await picture(page);
    assert.ok(count > 50);
    assert.ok((await page.locator('#clash-list .row').count()) < 60, 'only the rows in sight are in the document');
    await page.evaluate(() => (document.querySelector('#clash-list').scrollTop = 1e9));
    await settled(page);
    assert.equal(await page.locator('#clash-list .row .rank').last().textContent(), '15\u202f000');
    await page.locator('#clash-list .row').last().click();
    assert.match(await page.textContent('#legend'), /^Apart \d+Bpart \d+$/);
    await page.keyboard.press('Escape');
    await page.keyboard.press('f');
    const { x, y } = await page.evaluate(() => window.impinge.screenPlace(5050));
    await page.mouse.click(x, y);
    await page.waitForFunction(() => window.impinge.store.state.part >= 0);
    await page.fill('#parts-search', 'part 9999');
    assert.deepEqual(await listed(page, '.name', '#parts-tree'), ['plant.stl', 'hall 9', 'row 99', 'part 9999']);
  });

  test('fingers turn, move and zoom', async (t) => {
    const page = await browser.visit(t, reviewPage(), { width: 390, height: 800, touch: true });
    const box = await page.locator('#canvas').boundingBox();
    const session = await page.context().newCDPSession(page);
    const fingers = (type, points) =>
      session.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: points.map(([x, y], id) => ({ x: box.x + x, y: box.y + y, id })),
      });
    const before = await stand(page);
    await fingers('touchStart', [[150, 150]]);
    await fingers('touchMove', [[190, 170]]);
    await fingers('touchEnd', []);
    const turned = await stand(page);
    assert.notEqual(turned.yaw, before.yaw);
    assert.deepEqual(turned.target, before.target);
    await fingers('touchStart', [
      [150, 150],
      [200, 150],
    ]);
    await fingers('touchMove', [
      [120, 150],
      [230, 150],
    ]);
    await fingers('touchEnd', []);
    const zoomed = await stand(page);
    assert.ok(zoomed.distance < turned.distance);
    assert.equal(zoomed.yaw, turned.yaw);
    const { x, y } = await page.evaluate(() => window.impinge.screenPlace(10));
    await page.touchscreen.tap(x, y);
    assert.ok((await page.evaluate(() => window.impinge.store.state.part)) >= -1);
  });
});

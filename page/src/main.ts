// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Puts the page together: first what can be read, then what can be seen.
import { inAddress, tellAddress } from './address';
import { placeOf, rankClashes } from './clashes';
import { ClashList, sentenceOf } from './clash-list';
import { usualLink } from './clusters';
import { BlockError, readReport, readScene, type Report, type SceneBlock } from './data';
import { Decisions } from './decisions';
import { Details } from './details';
import { byId, button, el } from './dom';
import { Filters } from './filters';
import { counted, nameText, plural, setUnit } from './format';
import { listenForKeys, makeHelp, type Shortcut } from './keys';
import { makeMatrix } from './matrix';
import { type Motion, pairsOf, readMotion } from './motion';
import { PartsTree } from './parts-tree';
import { Stage } from './stage';
import { Store } from './store';
import { showSummary, tellSimplified, titleOf } from './summary';
import { listenToTheme } from './theme';
import { Timeline } from './timeline';
import { showTolerance } from './tolerance';

function tell(error: unknown): void {
  const trouble = byId('trouble');
  trouble.hidden = false;
  const text = error instanceof BlockError ? error.message : `This page met an error of its own: ${String(error)}`;
  trouble.append(el('span', {}, text));
}

function readOrTell<T>(read: () => T): T | null {
  try {
    return read();
  } catch (error) {
    tell(error);
    return null;
  }
}

/** The part of a name that instances of one mesh share. */
const stem = (name: string): string => name.replace(/ \(\d+\)$/, '');

function typesOf(report: Report, scene: SceneBlock | null): (id: number) => { key: number; title: string } {
  const firsts = new Map<number, number>();
  scene?.objects.forEach(({ mesh }, id) => {
    if (mesh >= 0 && !firsts.has(mesh)) firsts.set(mesh, id);
  });
  return (id) => {
    const mesh = scene?.objects[id].mesh ?? -1;
    const first = firsts.get(mesh) ?? id;
    return { key: mesh >= 0 ? mesh : 1e9 + id, title: stem(report.objects[first].name) };
  };
}

/** A button, once something is changed, that gives all decisions as a file. */
function makeSaving(decisions: Decisions, store: Store): void {
  const save = button('Save decisions', () => {
    const link = el('a', { download: 'decisions.json' });
    link.href = URL.createObjectURL(new Blob([decisions.file()], { type: 'application/json' }));
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
    byId('live').textContent = 'Saved as decisions.json';
  });
  save.id = 'save-decisions';
  save.className = 'primary';
  const update = () => {
    save.hidden = decisions.changes === 0;
    save.title = `${plural(decisions.changes, 'decision')} changed: all as a file for impinge clash --decisions`;
  };
  store.listen((_, changed) => {
    if (changed.has('decided')) update();
  });
  update();
  byId('clashes-actions').append(save);
}

function makePage(report: Report, scene: SceneBlock | null, motion: Motion | null): void {
  const store = new Store(report.objects.length);
  if (motion) {
    report.pairs = pairsOf(motion);
    store.set({ time: motion.times[0], colourBy: 'verdict' });
  }
  const clashes = rankClashes(report);
  store.set({ link: usualLink(clashes.map(placeOf).filter((place) => place !== null)) });
  const pairs = report.pairs.length;
  const isReview = report.settings !== null || motion !== null;
  document.body.classList.toggle('view-only', !isReview);
  if (!isReview) document.body.dataset.pane = 'parts';

  showSummary(report, motion, clashes, titleOf(report, scene), (clash) => store.select(clash));
  const stage = new Stage(report, store, motion, () => clashes.length > 0);
  new PartsTree(report, scene, clashes, store, (parts) => stage.fitParts(parts));
  const countOf = (part: number) =>
    clashes.filter((one) => one.pair && (one.first === part || one.second === part)).length;
  const decisions = new Decisions(report, titleOf(report, scene), store);
  const partTitle = (id: number) => report.objects[id].name;
  const list = new ClashList(clashes, { title: partTitle, typeOf: typesOf(report, scene) }, store);
  new Details(report, decisions, countOf, store, (clash) => list.around(clash), (parts) => stage.fitParts(parts));
  new Filters(report, clashes, store, partTitle);
  showTolerance(report, clashes, store);
  makeMatrix(report, clashes, store);
  if (decisions.canDecide) makeSaving(decisions, store);
  const timeline = motion && new Timeline(motion, clashes, store, () => list.visible);

  const back = button('◂', () => list.step(-1), { 'aria-label': 'Previous clash', title: 'Previous clash (K)' });
  const next = button('▸', () => list.step(1), { 'aria-label': 'Next clash', title: 'Next clash (J)' });
  const leave = button('✕', () => store.set({ clash: null, part: -1 }), {
    'aria-label': 'Leave',
    title: 'Leave (Escape)',
  });
  const position = el('span', { class: 'count' });
  if (pairs) byId('details-steps').append(position, back, next, leave);

  store.listen((state, changed) => {
    const { clash } = state;
    if (changed.has('clash') || changed.has('part')) {
      position.textContent = clash ? `${counted(clash.rank)} of ${counted(clashes.length)}` : '';
      if (changed.has('clash') && clash)
        byId('live').textContent = sentenceOf(clash, `${clash.rank} of ${clashes.length}`);
      else if (state.part >= 0) byId('live').textContent = `Part ${nameText(report.objects[state.part].name, 80)}`;
      if (changed.has('clash') && !motion) tellAddress(clash ? `#clash=${clash.rank}` : '');
    }
    if (changed.has('hidden')) byId('live').textContent = `${byId('parts-count').textContent} parts`;
  });

  const panes = [...document.querySelectorAll<HTMLButtonElement>('#panes button')];
  const showPane = (name: string) => {
    document.body.dataset.pane = name;
    for (const one of panes) one.setAttribute('aria-pressed', String(one.dataset.pane === name));
  };
  for (const one of panes) one.addEventListener('click', () => showPane(one.dataset.pane!));
  showPane(document.body.dataset.pane!);

  const toggleTheme = listenToTheme(() => stage.takeTheme());
  const escape = () => {
    if (!stage.closePanel()) store.set({ clash: null, part: -1 });
  };
  const shortcuts: Shortcut[] = [
    ...(pairs ? [{ keys: ['j'], text: 'next clash', act: () => list.step(1) }] : []),
    ...(pairs ? [{ keys: ['k'], text: 'previous clash', act: () => list.step(-1) }] : []),
    ...(timeline?.shortcuts() ?? []),
    { keys: ['Escape'], text: 'close a panel; leave the clash or the part', act: escape },
    ...stage.shortcuts(),
    {
      keys: ['/'],
      text: 'filter the clashes by name',
      act: () => byId(isReview ? 'clash-search' : 'parts-search').focus(),
    },
    { keys: ['t'], text: 'light or dark', act: toggleTheme },
    { keys: ['?'], text: 'this help', act: () => byId<HTMLDialogElement>('help').showModal() },
  ];
  listenForKeys(shortcuts);
  makeHelp(shortcuts);

  const followHash = () => {
    const wanted = inAddress('clash');
    const clash = clashes.find((one) => one.pair?.id === wanted) ?? clashes[Number(wanted) - 1];
    if (wanted && clash) store.select(clash);
    const time = inAddress('t');
    if (time) timeline?.seek(Number(time));
  };
  addEventListener('hashchange', followHash);

  const ready = (async () => {
    if (!scene) return;
    tellSimplified(scene);
    await stage.load(scene);
  })().catch(tell);
  // The list first: what is chosen is flown to when there is something to see.
  followHash();

  Object.assign(window, {
    impinge: {
      ready,
      clashes,
      store,
      visible: () => list.visible,
      frames: () => stage.view?.frames ?? 0,
      stand: () => stage.view?.camera.stand ?? null,
      screenPlace: (id: number) => stage.screenPlace(id),
      poseOf: (id: number) => stage.view?.assembly?.poseOf(id) ?? null,
    },
  });
}

try {
  const report = readReport();
  if (report.unit) setUnit(report.unit.metres);
  const scene = readOrTell(() => readScene(report.objects.length));
  if (!scene) byId('stage-note').textContent = 'There is no 3D view of this report.';
  makePage(
    report,
    scene,
    readOrTell(() => readMotion(report.objects.length)),
  );
} catch (error) {
  document.body.classList.add('broken');
  listenToTheme(() => undefined);
  tell(error);
  if (!(error instanceof BlockError)) throw error;
}

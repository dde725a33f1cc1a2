// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The top of the page: what came out, in plain words.
import { changeOf, type Clash, countVerdicts, isWorse, toldDepth, verdictName } from './clashes';
import { kVerdicts, type Report, type SceneBlock, type Verdict } from './data';
import { byId, button, countOf, el, intervalOf, lengthOf, nameOf, numberOf, sayUnit } from './dom';
import { counted, fileName, nameText, plural } from './format';
import type { Motion } from './motion';

type Fact = (Node | string)[];

const countedOf = (n: number, one: string, many = `${one}s`): Fact => [countOf(n), ` ${n === 1 ? one : many}`];

function partFacts(report: Report, motion: Motion | null): Fact {
  const files = new Set(report.objects.map((part) => part.file)).size;
  const facts: Fact = [...countedOf(report.objects.length, 'part'), ` in ${plural(files, 'file')}`];
  if (motion) facts.push(`, ${counted(motion.objects.length)} of them moving`);
  const classes: [string, number][] = (['solid', 'cracked', 'surface'] as const).map((one) => [
    one === 'cracked' ? 'cracked solid' : one,
    report.objects.filter((part) => part.class === one).length,
  ]);
  const counts = classes.filter(([, count]) => count).map(([what, count]) => plural(count, what));
  if (counts.length) facts.push(`: ${counts.join(', ')}`);
  return facts;
}

function deepestFact(report: Report, clashes: Clash[], choose: (clash: Clash) => void): Fact | null {
  if (!report.settings && !clashes.length) return null;
  if (report.settings?.depth_precision === null) return ['depths not measured'];
  const deepest = clashes.reduce<Clash | null>(
    (best, clash) => (clash.depth > (best?.depth ?? -1) ? clash : best),
    null,
  );
  if (!deepest) return ['nothing overlaps'];
  const link = button('', () => choose(deepest), { class: 'link' });
  link.append(nameOf(deepest.names[0], 60), ' and ', nameOf(deepest.names[1], 60));
  return ['deepest overlap ', ...intervalOf(...toldDepth(deepest)), ', ', link];
}

function toleranceFact(report: Report): Fact | null {
  if (!report.settings) return null;
  if (report.settings.tolerance !== 'auto') return ['tolerance ', lengthOf(report.settings.tolerance)];
  let [least, greatest] = [Infinity, -Infinity];
  for (const { tolerance } of report.pairs) {
    if (tolerance == null) continue;
    least = Math.min(least, tolerance);
    greatest = Math.max(greatest, tolerance);
  }
  if (!(least <= greatest)) return ['tolerance automatic'];
  if (least === greatest) return ['tolerance automatic, ', lengthOf(least)];
  return ['tolerance automatic, ', numberOf(least), ' to ', lengthOf(greatest)];
}

/** The same counts as the command prints. */
function changeFact(report: Report): Fact | null {
  const changes = report.pairs.map(changeOf).filter((change) => change !== null);
  if (!report.settings?.previous && !changes.length && !report.resolved?.length) return null;
  const count = (wanted: string) => changes.filter((change) => change === wanted).length;
  const fact: Fact = [
    'since the last report ',
    el('strong', {}, counted(count('new'))),
    ' new, ',
    el('strong', {}, counted(count('new region'))),
    ' with a new region, ',
    countOf(count('persisting')),
    ' persisting, ',
    countOf(report.resolved?.length ?? 0),
    ' resolved',
  ];
  const worse = report.pairs.filter(isWorse).length;
  if (worse) fact.push('; ', el('strong', {}, counted(worse)), ' worse than before');
  return fact;
}

/** With tests their modes say what fails, and `new`, if it is there, which of that. */
function failsFact({ settings, tests }: Report): Fact | null {
  if (!settings?.fail_on) return null;
  if (!tests?.length) return [`fails on ${settings.fail_on.join(', ') || 'nothing'}`];
  return [`fails by the mode of each test${settings.fail_on.includes('new') ? ', only what is new' : ''}`];
}

/** What was looked at, and what such looking cannot see. */
function stepsFact({ animation }: Motion): Fact {
  return [
    'looked at ',
    ...countedOf(animation.frames, 'step'),
    ' of ',
    numberOf(animation.step),
    ' s, and between them along screws: a clash that is over within one step is missed only where its parts touch at ' +
      'both ends of the step, change their shape or move otherwise',
  ];
}

const kMostLeftOut = 3;

/** What the answer is not about, or may be wrong for: sentences, and what they are called. */
function leftOutFacts(what: string, list: string[]): Fact[] {
  const told = (text: string): Fact => [el('span', { class: 'left-out bad' }, `${what}: ${text}`)];
  const facts = list.slice(0, kMostLeftOut).map((text) => told(nameText(text, 1500)));
  const more = list.length - facts.length;
  if (more > 0) facts.push(told(`${plural(more, 'more thing')}, which the JSON lists`));
  return facts;
}

function motionLine({ animation }: Motion, clashes: Clash[]): Node[] {
  const line = el('strong', { class: clashes.length ? 'bad' : 'good' });
  if (clashes.length) line.append(...countedOf(clashes.length, 'clash', 'clashes'));
  else line.append('No clash seen');
  line.append(' in ', numberOf(animation.seconds), ' s of motion');
  return [line, verdictList(countVerdicts(clashes))];
}

function verdictList(counts: [Verdict, number][]): HTMLElement {
  const list = el('span', { class: 'verdicts' });
  for (const [verdict, count] of counts)
    if (count) list.append(el('span', { class: `verdict ${verdict}` }, countOf(count), ` ${verdictName(verdict)}`));
  return list;
}

function verdictLine(report: Report): Node[] {
  const { counts, settings } = report;
  if (!settings || !counts) return [];
  const failing = el('strong', { class: counts.fail ? 'bad' : 'good' });
  if (counts.fail) failing.append(...countedOf(counts.fail, 'clash fails', 'clashes fail'));
  else failing.append('Nothing fails');
  const parts: Node[] = [failing];
  const list = verdictList(kVerdicts.map((verdict) => [verdict, counts[verdict]]));
  parts.push(list.childNodes.length ? list : el('span', { class: 'verdicts' }, 'no two parts touch'));
  return parts;
}

export function showSummary(
  report: Report,
  motion: Motion | null,
  clashes: Clash[],
  title: string,
  choose: (clash: Clash) => void,
): void {
  byId('title').replaceChildren(nameOf(title, 120));
  document.title = `${report.settings ? 'Clashes: ' : motion ? 'Motion: ' : ''}${nameText(title, 120)}`;
  byId('verdict-line').replaceChildren(...(motion ? motionLine(motion, clashes) : verdictLine(report)));
  const facts: (Fact | null)[] = [
    ...leftOutFacts('not read', report.missing ?? []),
    ...leftOutFacts('left out', motion?.left_out ?? []),
    ...leftOutFacts('warning', report.warnings ?? []),
    motion && stepsFact(motion),
    partFacts(report, motion),
    motion && motion.animation.name ? ['animation ', nameOf(motion.animation.name, 60)] : null,
    changeFact(report),
    deepestFact(report, clashes, choose),
    toleranceFact(report),
  ];
  if (report.settings?.clearance) facts.push(['clearance ', lengthOf(report.settings.clearance)]);
  const { unit } = report;
  if (unit?.name) sayUnit(unit.name);
  if (unit) facts.push([`lengths in ${unit.name ?? `${unit.metres} m`}`]);
  facts.push(failsFact(report));
  const rules = report.settings?.ignore?.length ?? 0;
  if (rules) facts.push(countedOf(rules, 'rule leaves pairs out', 'rules leave pairs out'));
  byId('facts').replaceChildren();
  for (const fact of facts) if (fact) byId('facts').append(el('span', {}, ...fact));
}

/** Says that what is seen is coarser than what was computed on. */
export function tellSimplified(scene: SceneBlock): void {
  if (scene.shown >= scene.triangles) return;
  const why = scene.shown > (scene.asked ?? Infinity) ? ', as with fewer parts would lose their shape' : '';
  const counts = ['3D simplified to ', countOf(scene.shown), ' of ', countOf(scene.triangles)];
  byId('facts').append(el('span', {}, ...counts, ` triangles${why}; figures are of the full model`));
}

export const titleOf = (report: Report, scene: SceneBlock | null): string =>
  scene?.title ?? [...new Set(report.objects.map((part) => fileName(part.file)))].slice(0, 3).join(', ');

// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Keys that work everywhere on the page, and the dialog that lists all of them.
import { byId, dialogHead, el } from './dom';

export interface Shortcut {
  keys: string[];
  text: string;
  act: (key: string) => void;
}

/** What fields, buttons and panels that scroll use these keys for goes first. */
function isOwn(key: string, target: HTMLElement): boolean {
  if (key === ' ') return target.matches('input, button, summary, #details-body');
  return /^(Arrow|Home|End)/.test(key) && target.matches('input, #details-body');
}

const kElsewhere: [string, string][] = [
  ['Arrow keys', 'turn the view; go through a list'],
  ['Shift + arrow keys', 'move the view'],
  ['+ −', 'nearer, farther'],
  ['Enter', 'choose the row of a list; open or close a group'],
  ['H, I, C in the tree', 'hide, isolate, list only the clashes of the row'],
  ['Drag, one finger', 'turn the view'],
  ['Right or Shift + drag, two fingers', 'move the view'],
  ['Wheel, pinch', 'nearer, farther'],
  ['Double click', 'fit a part'],
];

const kSpelled: Record<string, string> = { ' ': 'Space', ArrowLeft: '←', ArrowRight: '→' };

/** Single keys would be in the way of speech input: the dialog switches them off. */
let areOn = true;

export function listenForKeys(shortcuts: Shortcut[]): void {
  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.querySelector('dialog[open]')) return;
    const target = event.target as HTMLElement;
    const isField = target.matches('input:not([type=checkbox], [type=range]), select, textarea');
    if (isField) return;
    if (!areOn && event.key !== 'Escape') return;
    if (isOwn(event.key, target)) return;
    const shortcut = shortcuts.find(({ keys }) => keys.includes(event.key));
    if (!shortcut) return;
    event.preventDefault();
    shortcut.act(event.key);
  });
}

export function makeHelp(shortcuts: Shortcut[]): void {
  const dialog = byId<HTMLDialogElement>('help');
  const rows = el('dl', { class: 'keys' });
  const add = (keys: Node[], text: string) => rows.append(el('dt', {}, ...keys), el('dd', {}, text));
  for (const { keys, text } of shortcuts) {
    const shown = keys.length > 3 ? [`${keys[0]} to ${keys[keys.length - 1]}`] : keys;
    const spelled = (key: string) => kSpelled[key] ?? (key.length === 1 ? key.toUpperCase() : key);
    add(shown.map((key) => el('kbd', {}, spelled(key))), text); // prettier-ignore
  }
  for (const [keys, text] of kElsewhere) add([el('kbd', {}, keys)], text);
  const input = el('input', { type: 'checkbox', checked: true, id: 'single-keys' });
  input.addEventListener('change', () => (areOn = input.checked));
  dialog.append(
    dialogHead(dialog, 'Keys and gestures'),
    rows,
    el('label', { class: 'check' }, input, ' Single keys work everywhere on the page'),
  );
  byId('help-button').addEventListener('click', () => dialog.showModal());
}

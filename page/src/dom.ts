// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Making elements. All text goes in as text: nothing that a file says is ever read as markup.
import { counted, nameText, rounded, volumeText } from './format';

type Child = Node | string | null | undefined | false;

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number | boolean | null | undefined> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) element.setAttribute(name, '');
    else if (value !== false && value != null) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/** A measured number, rounded, with all its digits in the title. */
export function numberOf(value: number | null | undefined): HTMLElement {
  if (value == null || Number.isNaN(value)) return el('span', { class: 'none' }, '–');
  return el('span', { class: 'number', title: String(value) }, rounded(value));
}

/** A length, or an area by its power, with the unit behind it where that is known (`sayUnit`). */
export function lengthOf(value: number | null | undefined, power: 1 | 2 = 1): HTMLElement {
  const number = numberOf(value);
  if (number.classList.contains('number')) number.classList.add(`in-unit-${power}`);
  return number;
}

/** Between which lengths one is known to lie. */
export const intervalOf = (low: number, high: number): (Node | string)[] =>
  rounded(low) === rounded(high) ? [lengthOf(high)] : [numberOf(low), ' to ', lengthOf(high)];

/** A volume in a unit of its size (`volumeText`), and how far it may be off; the run's own in the title. */
export const volumeOf = (value: number, error?: number): HTMLElement =>
  el('span', { class: 'number', title: String(value) }, volumeText(value, error));

/** What stands behind all lengths and areas from now on, by the style sheet. */
export function sayUnit(name: string): void {
  const style = document.documentElement.style;
  ['', '²'].forEach((power, i) => style.setProperty(`--unit-${i + 1}`, `"\u00a0${name}${power}"`));
}

export const countOf = (value: number): HTMLElement =>
  el('span', { class: 'number', title: String(value) }, counted(value));

/** A name from a file, kept from steering the text around it. */
export function nameOf(name: string, longest = 200): HTMLElement {
  return el('bdi', { class: 'name', title: nameText(name, 2000) }, nameText(name, longest));
}

/** Which of the two parts of a clash: A or B, in its colour. */
export const letterOf = (side: number): HTMLElement =>
  el('span', { class: `letter side-${'ab'[side]}` }, 'AB'[side]);

export function button(
  text: string,
  onClick: () => void,
  attributes: Record<string, string | boolean> = {},
): HTMLButtonElement {
  const element = el('button', { type: 'button', ...attributes }, text);
  element.addEventListener('click', onClick);
  return element;
}

/** A choice of one of several values, each with the text that says it. */
export function chooser<T extends string>(
  choices: readonly (readonly [value: T, text: string])[],
  onChange: (value: T) => void,
  attributes: Record<string, string>,
): HTMLSelectElement {
  const select = el('select', attributes);
  for (const [value, text] of choices) select.append(el('option', { value }, text));
  select.addEventListener('change', () => onChange(select.value as T));
  return select;
}

export const labelled = (label: string, field: HTMLElement): HTMLLabelElement =>
  el('label', { class: 'field' }, el('span', {}, label), field);

/** The title of a dialog, a choice of what it shows if there is one, and what closes it. */
export const dialogHead = (dialog: HTMLDialogElement, title: string, choice?: HTMLElement): HTMLElement =>
  el(
    'div',
    { class: 'pane-head' },
    el('h2', { id: `${dialog.id}-title` }, title),
    choice,
    button('Close', () => dialog.close(), { autofocus: !choice }),
  );

/** A field that searches a list; the arrow down goes to the list. */
export function searchField(
  id: string,
  placeholder: string,
  label: string,
  list: string,
  onInput: () => void,
): HTMLInputElement {
  const field = el('input', { type: 'search', placeholder, 'aria-label': label, id });
  field.addEventListener('input', onInput);
  field.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowDown') return;
    event.preventDefault();
    byId(list).focus();
  });
  return field;
}

export function setPressed(element: Element, isPressed: boolean): void {
  element.setAttribute('aria-pressed', String(isPressed));
}

// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// How many pairs fail between which files, classes or storeys: a table whose cells filter the list.
import { type Clash, emptyFilter, type Trait, traitName, traitsOf, traitTitle, traitValues } from './clashes';
import type { Report } from './data';
import { byId, button, chooser, dialogHead, el, nameOf } from './dom';
import { counted, nameText, plural } from './format';
import type { Store } from './store';

const kTraits: [Trait, string][] = [
  ['file', 'by files'],
  ['class', 'by classes'],
  ['storey', 'by storeys'],
];

/** A row and a column for each value that a failing pair has; each two values meet in one cell. */
function tableOf(failing: Clash[], trait: Trait, choose: (values: [string, string]) => void): HTMLTableElement {
  const counts = new Map<string, number>();
  for (const clash of failing) {
    const key = traitsOf(clash, trait).join('\n');
    counts.set(key, (counts.get(key) ?? 0) + 1);
  }
  const most = Math.max(...counts.values());
  const values = traitValues(failing.flatMap((clash) => clash.parts), trait);
  const table = el('table');
  const heads = values.map((value) => el('th', { scope: 'col' }, nameOf(traitName(value, trait), 40)));
  table.append(el('tr', {}, el('td'), ...heads));
  values.forEach((second, i) => {
    const row = el('tr', {}, el('th', { scope: 'row' }, nameOf(traitName(second, trait), 60)));
    for (const first of values.slice(0, i + 1)) {
      const count = counts.get(`${first}\n${second}`);
      const cell = el('td');
      if (count) {
        const title = `${nameText(traitTitle([first, second], trait))}: ${plural(count, 'pair fails', 'pairs fail')}`;
        cell.append(button(counted(count), () => choose([first, second]), { title, 'aria-label': title }));
        cell.style.setProperty('--share', String(Math.log1p(count) / Math.log1p(most)));
      }
      row.append(cell);
    }
    table.append(row);
  });
  return table;
}

/** Nothing where nothing fails, or all parts are alike. */
export function makeMatrix(report: Report, clashes: Clash[], store: Store): void {
  const failing = clashes.filter((clash) => clash.pair?.fails);
  const traits = kTraits.filter(([trait]) => traitValues(report.objects, trait).length > 1);
  if (!report.settings || !failing.length || !traits.length) return;
  const dialog = byId<HTMLDialogElement>('matrix');
  const host = el('div', { class: 'matrix', tabindex: 0, role: 'group', 'aria-labelledby': 'matrix-title' });
  const show = (trait: Trait) => {
    const choose = (values: [string, string]) => {
      store.set({ filter: { ...emptyFilter(), failing: true, traits: { trait, values } } });
      dialog.close();
      byId('clash-list').focus();
    };
    host.replaceChildren(tableOf(failing, trait, choose));
  };
  const by = chooser(traits, show, { id: 'matrix-by', 'aria-label': 'Count by' });
  dialog.append(dialogHead(dialog, 'Failing pairs', by), host);
  const open = button('Matrix', () => dialog.showModal(), { id: 'matrix-button', 'aria-haspopup': 'dialog' });
  byId('clashes-actions').append(open);
  show(traits[0][0]);
}

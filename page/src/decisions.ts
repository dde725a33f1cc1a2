// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What people decide about clashes on the page. The browser keeps it, where it may, until it is saved as the file that
// impinge clash --decisions reads.
import type { Pair, Report } from './data';
import type { Store } from './store';

export const kDecisionKeys = ['status', 'assignee', 'due', 'comment'] as const;
export type Decision = Record<(typeof kDecisionKeys)[number], string>;

const kStatuses = ['open', 'active', 'reviewed', 'approved', 'resolved'];

const decisionOf = (pair: Pair): Decision => ({
  status: pair.status ?? '',
  assignee: pair.assignee ?? '',
  due: pair.due ?? '',
  comment: pair.comment ?? '',
});

/** What is not empty of it. */
export const saidOf = (pair: Pair): Partial<Decision> =>
  Object.fromEntries(Object.entries(decisionOf(pair)).filter(([, text]) => text));

/** FNV-1a, of 32 bits. */
function hashOf(text: string): string {
  let hash = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i) hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193);
  return (hash >>> 0).toString(16);
}

export class Decisions {
  /** What the report says, of the pairs that can be decided on. */
  private readonly given = new Map<Pair, string>();
  private readonly changed = new Set<Pair>();
  /** Of the report with its decisions: pages that are opened from disk may share one storage. */
  private readonly key: string;

  constructor(
    private readonly report: Report,
    title: string,
    private readonly store: Store,
  ) {
    for (const pair of report.pairs) if (pair.id) this.given.set(pair, JSON.stringify(decisionOf(pair)));
    const identity = [...this.given].map(([pair, given]) => pair.id + given).join('\n');
    this.key = `impinge decisions: ${title} ${this.given.size} ${hashOf(identity)}`;
    this.recall();
  }

  get canDecide(): boolean {
    return this.given.size > 0;
  }

  /** How many differ from those of the report. */
  get changes(): number {
    return this.changed.size;
  }

  /** The usual ones, and those of the report. */
  get statuses(): string[] {
    const used = [...this.given.keys()].map((pair) => pair.status ?? '').filter(Boolean);
    return [...new Set([...kStatuses, ...used])];
  }

  decide(pairs: Pair[], decision: Partial<Decision>): void {
    for (const pair of pairs) if (this.given.has(pair)) this.apply(pair, decision);
    this.keep();
    this.store.set({ decided: this.store.state.decided + 1 });
  }

  /** What was read, with the changes by the pairs' ids: one that says nothing takes back what names of parts say. */
  file(): string {
    const file: Record<string, unknown> = { $schema: 'decisions.schema.json', ...this.report.decisions };
    for (const pair of this.changed) file[pair.id!] = saidOf(pair);
    return `${JSON.stringify(file, null, 2)}\n`;
  }

  private apply(pair: Pair, decision: Partial<Decision>): void {
    for (const key of kDecisionKeys) if (typeof decision[key] === 'string') pair[key] = decision[key] || null;
    if (JSON.stringify(decisionOf(pair)) === this.given.get(pair)) this.changed.delete(pair);
    else this.changed.add(pair);
  }

  private keep(): void {
    const kept = [...this.changed].map((pair) => [pair.id, decisionOf(pair)]);
    try {
      if (kept.length) localStorage.setItem(this.key, JSON.stringify(Object.fromEntries(kept)));
      else localStorage.removeItem(this.key);
    } catch {
      // Some browsers keep nothing for files; what is decided then lasts as long as the page is open.
    }
  }

  private recall(): void {
    try {
      const kept = JSON.parse(localStorage.getItem(this.key) ?? '{}') as Record<string, Partial<Decision>>;
      for (const pair of this.given.keys()) if (kept[pair.id!]) this.apply(pair, kept[pair.id!]);
    } catch {
      // As above.
    }
  }
}

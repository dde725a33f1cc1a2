// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Numbers and names as the page writes them.
import type { PlacedSpan } from './motion';

/** Four significant digits, all digits of a whole part below ten million. */
export function rounded(value: number): string {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) {
    const [digits, power] = value.toExponential(3).split('e');
    return `${String(Number(digits))}e${String(Number(power))}`.replace(/-/g, '−');
  }
  const decimals = Math.max(0, 3 - Math.floor(Math.log10(size)));
  return String(Number(value.toFixed(decimals))).replace('-', '−');
}

/** The number that is read where a value stands rounded. */
export const shown = (value: number): number => Number(rounded(value).replace(/−/g, '-'));

const [kFoot, kInch] = [0.3048, 0.0254];
/** Units of volume, the largest first, in cubic metres. */
const kMetric: [string, number][] = [['m³', 1], ['L', 1e-3], ['cm³', 1e-6], ['mm³', 1e-9]]; // prettier-ignore
const kImperial: [string, number][] = [['ft³', kFoot ** 3], ['in³', kInch ** 3]]; // prettier-ignore

let metresInUnit = NaN;
/** Metres in the run's unit of length, which the volumes that are written from now on are in. */
export const setUnit = (metres: number): void => void (metresInUnit = metres);

/** A volume in the largest unit that it has one of, as the command's table has it; in none where the run's is not known. */
export function volumeText(value: number, error?: number): string {
  const isImperial = [kFoot, kInch].some((unit) => Math.abs(metresInUnit - unit) < 1e-9 * unit);
  const cubic = value * metresInUnit ** 3;
  const units = isImperial ? kImperial : kMetric;
  const [name, size] = units.find(([, one]) => Math.abs(cubic) >= one) ?? units[units.length - 1];
  const figure = (volume: number) => rounded(Number.isNaN(metresInUnit) ? volume : (volume * metresInUnit ** 3) / size);
  const text = error === undefined ? figure(value) : `${figure(value)} ± ${figure(error)}`;
  return Number.isNaN(metresInUnit) ? text : `${text}\u00a0${name}`;
}

/** From when to when, in words as few as a row has room for. */
export function spanText(span: PlacedSpan): string {
  const [start, end] = [rounded(span.start), rounded(span.end)];
  if (span.isFromStart && span.isToEnd) return 'all the time';
  if (span.isFromStart) return `until ${end} s`;
  return span.isToEnd ? `from ${start} s on` : `${start} to ${end} s`;
}

/** The same where there is room, with whether a frame shows it. */
export const wholeSpanText = (span: PlacedSpan): string =>
  spanText(span) + (span.isPassage ? ', between two frames' : '');

/** A count with thin spaces between thousands. */
export function counted(value: number): string {
  return String(value).replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');
}

export const plural = (n: number, one: string, many = `${one}s`): string => `${counted(n)} ${n === 1 ? one : many}`;

// Control characters, and those that turn the direction of text or hide in it, as the command's table spells them out.
const kUnseen = /[\u0000-\u001f\u007f-\u009f\u00ad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;

function spelled(character: string): string {
  if (character === '\n') return '\\n';
  if (character === '\t') return '\\t';
  const code = character.charCodeAt(0);
  return code < 256 ? `\\x${code.toString(16).padStart(2, '0')}` : `\\u${code.toString(16).padStart(4, '0')}`;
}

/** A name as it may stand on the page: nothing in it steers the text around it, and it is cut in the middle if long. */
export function nameText(name: string, longest = 200): string {
  const characters = name.length > longest ? `${name.slice(0, longest / 2)}…${name.slice(-longest / 2)}` : name;
  const text = characters.replace(kUnseen, spelled);
  return text === '' ? '(no name)' : text;
}

/** The last step of a file's path. */
export const fileName = (file: string): string => file.split(/[/\\]/).pop() || file;

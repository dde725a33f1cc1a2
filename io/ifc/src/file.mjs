// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The bytes of an IFC file, as they lie there or in a ZIP archive (.ifczip).
import * as buffer from 'node:buffer';
import { readFileSync } from 'node:fs';
import { inflateRawSync } from 'node:zlib';

// What is wrong with the file, as a sentence without a full stop.
export class FileProblem extends Error {}

// Of what a ZIP archive unpacks to: 32-bit sizes and a WebAssembly memory of 4 GiB end there as well.
const kMostUnpacked = 2 ** 31 - 1;

const kEndOfDirectory = 0x06054b50;
const kDirectoryEntry = 0x02014b50;
const kLocalEntry = 0x04034b50;

// The members of a ZIP archive (APPNOTE.TXT of PKWARE, sections 4.3.7, 4.3.12 and 4.3.16).
function membersOf(zip) {
  const lowest = Math.max(0, zip.length - 22 - 0xffff);
  let end = zip.length - 22;
  while (end >= lowest && zip.readUInt32LE(end) !== kEndOfDirectory) --end;
  if (end < lowest) throw new FileProblem('the archive is cut off: its directory is missing; copy or export it again');
  const members = [];
  let at = zip.readUInt32LE(end + 16);
  for (let left = zip.readUInt16LE(end + 10); left > 0; --left) {
    if (at + 46 > end || zip.readUInt32LE(at) !== kDirectoryEntry) {
      throw new FileProblem("the archive's directory is broken; copy or export it again");
    }
    const name = zip.toString('utf8', at + 46, at + 46 + zip.readUInt16LE(at + 28));
    members.push({
      name,
      flags: zip.readUInt16LE(at + 8),
      method: zip.readUInt16LE(at + 10),
      packed: zip.readUInt32LE(at + 20),
      size: zip.readUInt32LE(at + 24),
      local: zip.readUInt32LE(at + 42),
    });
    at += 46 + zip.readUInt16LE(at + 28) + zip.readUInt16LE(at + 30) + zip.readUInt16LE(at + 32);
  }
  return members;
}

function unpack(zip, member) {
  const { name, local, packed, size } = member;
  if (member.flags & 1) throw new FileProblem(`'${name}' in the archive is encrypted; export it without a password`);
  if (size > kMostUnpacked)
    throw new FileProblem(`'${name}' in the archive unpacks to more than 2 GiB; split the model`);
  if (local + 30 > zip.length || zip.readUInt32LE(local) !== kLocalEntry) {
    throw new FileProblem(`'${name}' is not where the archive's directory says; copy or export it again`);
  }
  const start = local + 30 + zip.readUInt16LE(local + 26) + zip.readUInt16LE(local + 28);
  const bytes = zip.subarray(start, start + packed);
  if (member.method === 0) return bytes;
  if (member.method !== 8) throw new FileProblem(`'${name}' is packed by method ${member.method}; pack it by deflate`);
  let unpacked;
  try {
    // No more than the directory says, whatever is packed there.
    unpacked = inflateRawSync(bytes, { maxOutputLength: Math.max(size, 1) });
  } catch (problem) {
    throw new FileProblem(`'${name}' in the archive cannot be unpacked (${problem.message}); copy or export it again`);
  }
  if (unpacked.length !== size) {
    throw new FileProblem(`'${name}' in the archive unpacks to ${unpacked.length} bytes, not ${size}; export it again`);
  }
  return unpacked;
}

function unzip(zip) {
  const models = membersOf(zip).filter((member) => /\.ifc$/i.test(member.name));
  if (models.length === 0) throw new FileProblem('the archive holds no file whose name ends in .ifc; put one in');
  if (models.length > 1) {
    throw new FileProblem(`the archive holds ${models.length} IFC files; unpack it and name those that you want`);
  }
  return unpack(zip, models[0]);
}

// Of Node.js 18.14 and newer; before, what is no UTF-8 is taken for it.
const isUtf8 = (bytes) => buffer.isUtf8?.(bytes) ?? true;

// What Windows-1252 has at 0x80 to 0x9f, where Latin-1 has controls; Node.js's own decoder takes it for that.
const kWindows = '€\x81‚ƒ„…†‡ˆ‰Š‹Œ\x8dŽ\x8f\x90‘’“”•–—˜™š›œ\x9džŸ';
const fromWindows = (bytes) =>
  bytes.toString('latin1').replace(/[\x80-\x9f]/g, (letter) => kWindows[letter.charCodeAt(0) - 0x80]);

// The same with all texts in UTF-8: the standard allows ASCII alone, but some programs write the letters of Windows-1252.
// Lines that are UTF-8 stay as they are.
function inUtf8(bytes) {
  if (isUtf8(bytes)) return bytes;
  const pieces = [];
  let done = 0;
  for (let at = 0; at < bytes.length; ++at) {
    if (bytes[at] < 0x80) continue;
    const start = Math.max(done, bytes.lastIndexOf('\n', at) + 1);
    const next = bytes.indexOf('\n', at);
    const end = next < 0 ? bytes.length : next;
    const line = bytes.subarray(start, end);
    if (!isUtf8(line)) {
      pieces.push(bytes.subarray(done, start), Buffer.from(fromWindows(line), 'utf8'));
      done = end;
    }
    at = end;
  }
  return Buffer.concat([...pieces, bytes.subarray(done)]);
}

// Errors: FileProblem, of a file that is no IFC in STEP's text form, and of one that is cut off.
export function readFile(path) {
  let bytes = readFileSync(path);
  if (bytes.length >= 22 && bytes.readUInt16LE(0) === 0x4b50) bytes = unzip(bytes);
  const start = bytes.toString('latin1', 0, 4096);
  if (/^\s*(\xef\xbb\xbf)?<\?xml/.test(start)) {
    throw new FileProblem(
      'this is IFC as XML, which is not read; export it as IFC-SPF, the text form with the ending .ifc',
    );
  }
  if (!/^(\xef\xbb\xbf)?(\s|\/\*.*?\*\/)*ISO-10303-21\s*;/s.test(start)) {
    throw new FileProblem("this is no IFC file: it does not begin with 'ISO-10303-21;'; export it as IFC again");
  }
  if (!/END-ISO-10303-21\s*;/.test(bytes.toString('latin1', Math.max(0, bytes.length - 65536)))) {
    throw new FileProblem(
      "the file is cut off: its last line, 'END-ISO-10303-21;', is missing; copy or export it again",
    );
  }
  return inUtf8(bytes);
}

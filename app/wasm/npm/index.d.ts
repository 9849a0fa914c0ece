// SPDX-License-Identifier: Apache-2.0
/** A value with its 95 % interval; u95 is half of it where it is symmetric. */
export interface Uncertain { value: number; u95: number; low95?: number; high95?: number }

export interface Light {
  name: string;
  kind: 'point' | 'directional' | 'spot' | 'sphere' | 'disk' | 'rect' | 'tube' | 'photometric' | 'dome';
  intensity_cd?: Uncertain;
  flux_lm?: Uncertain;
  illuminance_lx?: Uncertain;
  luminance_nits?: Uncertain;
  color?: { cct_K?: Uncertain; duv?: number | Uncertain; xy?: [number, number] };
  [key: string]: unknown;
}
export interface LightFile { schema: string; lights: Light[]; warnings?: Warning[]; [key: string]: unknown }
export interface Warning { code: string; subject: string; message: string }
export interface Color {
  xy: [number, number]; uv1960: [number, number]; uv1976: [number, number];
  cct_K?: number; duv?: number; cct_valid: boolean;
  rgb: Record<'srgb_linear' | 'acescg' | 'acescg_d65' | 'rec2020' | 'display_p3', [number, number, number]>;
  [key: string]: unknown;
}
export interface Exposure { ev: number; ev100: number; l_max_nits: number; exposure: number; [key: string]: unknown }

/** The command's options by their long names, camelCase for their hyphens: { fixture: "bulb" }. */
export type Options = Record<string, string | number | boolean | string[] | undefined>;

/** exitCode: 1 failed, 2 wrong words, 3 refused (the data cannot support an answer). */
export class LightcalError extends Error {
  exitCode: 1 | 2 | 3;
  code: string;
  subject?: string;
}

export interface CommandAnswer { code: number; out: string; err: string; files?: Record<string, Uint8Array> }
/** One command line; with `files` it sees these alone ("/lamp/session.toml": text or bytes). */
export function command(words: string[], options?: { files?: Record<string, string | Uint8Array> }): CommandAnswer;

export function quick(readings: string[], options?: Options): LightFile & { next_step: string };
export function run(session: string, options?: Options): LightFile & { files: string[] };
export function fit(session: string, options?: Options): LightFile;
export function exportLights(lights: string | string[], options?: Options): { files: string[] };
export function color(options: Options | { xy: [number, number] }): Color;
export function exposure(options: Options): Exposure;
export function photometric(file: string, options?: Options): Record<string, unknown>;
export function ratio(key: string, fill: string, options?: Options): { ratio: Uncertain; stops: Uncertain; [key: string]: unknown };

/** A message that cannot be used; the text says which member is wrong. */
export class FrameError extends Error {}

/** Twelve numbers: the upper three rows of a pose's matrix, row by row. */
export type Pose = Float64Array;

/** Reads members of a JSON object and checks them. Every getter throws FrameError. */
export class Fields {
  private readonly members: Record<string, unknown>;

  constructor(
    value: unknown,
    private readonly where: string,
  ) {
    if (typeof value !== "object" || value === null || Array.isArray(value))
      throw new FrameError(`${where}: no object`);
    this.members = value as Record<string, unknown>;
  }

  has(name: string): boolean {
    return this.members[name] !== undefined && this.members[name] !== null;
  }

  number(name: string): number {
    const value = this.members[name];
    if (typeof value !== "number" || !Number.isFinite(value))
      throw this.wrong(name, "no finite number");
    return value;
  }

  /** A number, or the fallback where it is missing or null. */
  numberOr<T>(name: string, fallback: T): number | T {
    return this.has(name) ? this.number(name) : fallback;
  }

  integer(name: string): number {
    const value = this.number(name);
    if (!Number.isSafeInteger(value)) throw this.wrong(name, "no whole number");
    return value;
  }

  /** How many of something. */
  count(name: string): number {
    const value = this.integer(name);
    if (value < 0) throw this.wrong(name, "negative");
    return value;
  }

  countOr(name: string, fallback: number): number {
    return this.has(name) ? this.count(name) : fallback;
  }

  text(name: string): string {
    const value = this.members[name];
    if (typeof value !== "string") throw this.wrong(name, "no text");
    return value;
  }

  textOr(name: string, fallback: string): string {
    return this.has(name) ? this.text(name) : fallback;
  }

  flag(name: string): boolean {
    const value = this.members[name];
    if (typeof value !== "boolean") throw this.wrong(name, "neither true nor false");
    return value;
  }

  flagOr(name: string, fallback: boolean): boolean {
    return this.has(name) ? this.flag(name) : fallback;
  }

  /** Finite numbers; `length` of them where it is given. */
  numbers(name: string, length?: number): number[] {
    const value = this.members[name];
    if (!Array.isArray(value) || !value.every((v) => typeof v === "number" && Number.isFinite(v)))
      throw this.wrong(name, "no list of finite numbers");
    if (length !== undefined && value.length !== length)
      throw this.wrong(name, `${value.length} numbers instead of ${length}`);
    return value as number[];
  }

  numbersOr(name: string, fallback: number[]): number[] {
    return this.has(name) ? this.numbers(name) : fallback;
  }

  vector(name: string): [number, number, number] {
    return this.numbers(name, 3) as [number, number, number];
  }

  pose(name: string): Pose {
    return Float64Array.from(this.numbers(name, 12));
  }

  object(name: string): Fields {
    return new Fields(this.members[name], `${this.where}.${name}`);
  }

  list(name: string): Fields[] {
    const value = this.members[name];
    if (!Array.isArray(value)) throw this.wrong(name, "no list");
    return value.map((entry, i) => new Fields(entry, `${this.where}.${name}[${i}]`));
  }

  listOr(name: string): Fields[] {
    return this.has(name) ? this.list(name) : [];
  }

  wrong(name: string, how: string): FrameError {
    return new FrameError(`${this.where}.${name}: ${how}`);
  }
}

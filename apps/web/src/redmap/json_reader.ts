// Reads JSON documents of others: every value is checked, and complaints name file and key.

/** What is wrong with an export, where, what was expected and what was found. */
export class RedmapError extends Error {
  override name = 'RedmapError';
}

type Json = Record<string, unknown>;

/** Reads values of a JSON document and complains by file and key. */
export class JsonReader {
  constructor(
    readonly file: string,
    readonly key: string,
    readonly value: unknown,
  ) {}

  fail(expected: string): never {
    const found = this.value === undefined ? 'nothing' : JSON.stringify(this.value).slice(0, 80);
    throw new RedmapError(`${this.file}: ${this.key || 'document'}: expected ${expected}, found ${found}`);
  }
  at(key: string | number): JsonReader {
    if (typeof this.value !== 'object' || this.value === null) this.fail('an object');
    const name = typeof key === 'number' ? `[${key}]` : this.key ? `.${key}` : key;
    return new JsonReader(this.file, this.key + name, (this.value as Json)[key]);
  }
  text(): string {
    return typeof this.value === 'string' ? this.value : this.fail('a string');
  }
  number(): number {
    return typeof this.value === 'number' ? this.value : this.fail('a number');
  }
  /** A whole number from `least` to `most`. */
  count(least: number, most: number): number {
    const is = Number.isInteger(this.value) && (this.value as number) >= least && (this.value as number) <= most;
    return is ? (this.value as number) : this.fail(`a whole number from ${least} to ${most}`);
  }
  flag(): boolean {
    return typeof this.value === 'boolean' ? this.value : this.fail('true or false');
  }
  /** A name beside the manifest: nothing else is ever fetched. */
  fileName(): string {
    const name = this.text();
    return /^\w[\w.-]*$/.test(name) ? name : this.fail('the name of a file beside it');
  }
  list<T>(read: (item: JsonReader) => T): T[] {
    if (!Array.isArray(this.value)) this.fail('a list');
    return (this.value as unknown[]).map((_, i) => read(this.at(i)));
  }
}

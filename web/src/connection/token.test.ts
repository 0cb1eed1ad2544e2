import { expect, it } from 'vitest';
import { socketUrl, takeToken } from './token';

const place = (hash: string, protocol = 'http:') => ({ hash, protocol, host: 'h:8080', pathname: '/', search: '' }) as Location;

it('takes the token out of the address and remembers it', () => {
  const kept = new Map<string, string>();
  const storage = { getItem: (k: string) => kept.get(k) ?? null, setItem: (k: string, v: string) => kept.set(k, v) } as unknown as Storage;
  let address = '';
  const history = { replaceState: (_: unknown, __: string, to: string) => (address = to) } as unknown as History;
  expect(takeToken(place(''), storage, history)).toBeUndefined();
  expect(takeToken(place('#token=a%20b'), storage, history)).toBe('a b');
  expect(address).toBe('/');
  expect(takeToken(place(''), storage, history)).toBe('a b');
});

it('makes the WebSocket address', () => {
  expect(socketUrl(place(''), undefined)).toBe('ws://h:8080/api/v1/ws?subscribe');
  expect(socketUrl(place('', 'https:'), 'a b&')).toBe('wss://h:8080/api/v1/ws?subscribe&token=a%20b%26');
});

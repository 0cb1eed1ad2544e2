const KEY = 'lapwing.token';

/** The station's token from `#token=...` in the address, remembered for this tab and taken out of the address. */
export function takeToken(location: Location, storage: Storage, history: History): string | undefined {
  const found = new URLSearchParams(location.hash.slice(1)).get('token');
  if (found) {
    storage.setItem(KEY, found);
    history.replaceState(null, '', location.pathname + location.search);
  }
  return storage.getItem(KEY) ?? undefined;
}

export function rememberToken(token: string, storage: Storage): void {
  storage.setItem(KEY, token);
}

/** The station sends nothing but its hello until the page subscribes. */
export function socketUrl(location: Location, token: string | undefined): string {
  const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
  const query = token ? `&token=${encodeURIComponent(token)}` : '';
  return `${scheme}://${location.host}/api/v1/ws?subscribe${query}`;
}

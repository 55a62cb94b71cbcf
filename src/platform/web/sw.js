// Keeps the page's files, so that it opens without a network. `make web` fills in their names, and a version that changes as they do: a new
// one is fetched as a whole and takes over once no page of the old one is open.

const cached = 'wiggly-@VERSION@';
const files = ['./', ...'@FILES@'.split(' ')];

// Past the browser's own cache, which may hold another version.
self.addEventListener('install', event => event.waitUntil(
  caches.open(cached).then(cache => cache.addAll(files.map(file => new Request(file, { cache: 'no-cache' }))))));

async function takeOver() {
  for (const name of await caches.keys()) {
    if (name.startsWith('wiggly-') && name !== cached) await caches.delete(name);
  }
  await self.clients.claim();
}
self.addEventListener('activate', event => event.waitUntil(takeOver()));

/// What is not kept from the start, such as a character, is kept once it was fetched.
async function answer(request) {
  const cache = await caches.open(cached).catch(() => null);
  const kept = await cache?.match(request, { ignoreSearch: true }).catch(() => null);
  if (kept) return kept;
  const fetched = await fetch(request);
  if (fetched.ok && fetched.type === 'basic') await cache?.put(request, fetched.clone()).catch(() => {}); // it may be full
  return fetched;
}
self.addEventListener('fetch', event => {
  if (event.request.method === 'GET') event.respondWith(answer(event.request));
});

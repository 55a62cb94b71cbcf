// Keeps the page's files, so that it opens without a network. `make web` fills in their names, and a version that changes as they do.
const cached = 'wiggly-@VERSION@';
const files = ['./', ...'@FILES@'.split(' ')];

// Past the browser's own cache, which may be of another version.
async function fetchAll() {
    const cache = await caches.open(cached);
    await cache.addAll(files.map((file) => new Request(file, { cache: 'no-cache' })));
    await self.skipWaiting();
}

async function forgetOthers() {
    for (const name of await caches.keys()) {
        if (name.startsWith('wiggly-') && name !== cached) await caches.delete(name);
    }
    await self.clients.claim();
}

async function answer(request) {
    const cache = await caches.open(cached);
    return (await cache.match(request, { ignoreSearch: true })) ?? fetch(request);
}

self.addEventListener('install', (event) => event.waitUntil(fetchAll()));
self.addEventListener('activate', (event) => event.waitUntil(forgetOthers()));
self.addEventListener('fetch', (event) => {
    if (event.request.method === 'GET') event.respondWith(answer(event.request));
});

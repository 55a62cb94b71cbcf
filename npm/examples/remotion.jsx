import { Player } from '@remotion/player'
import { createRoot } from 'react-dom/client'
import { useCurrentFrame, useVideoConfig } from 'remotion'
import { spring } from 'wiggly'

const s = spring({ keys: [[0, 0], [0.4, 200], [1.2, 60]], frequency: 2, damping: 0.2 })

function Scene() {
  const { fps } = useVideoConfig()
  return <div id="box" style={{ translate: `${s.at(useCurrentFrame() / fps)}px` }} />
}

createRoot(document.querySelector('main')).render(
  <Player
    component={Scene}
    fps={60}
    durationInFrames={Math.ceil(60 * s.duration)}
    compositionWidth={400}
    compositionHeight={100}
    autoPlay
    initiallyMuted
    acknowledgeRemotionLicense
  />,
)

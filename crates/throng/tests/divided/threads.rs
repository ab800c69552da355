//! A halo of threads and channels.

use glam::Vec2;
use std::sync::mpsc::{Receiver, Sender, channel};
use throng::halo::{Agreement, Cuts, Halo};

/// What travels between two worlds.
enum Message {
    Agreement(Vec<u8>),
    Packet(Vec<u8>),
}

/// A world's end of the channels to and from all worlds.
pub struct Threads {
    index: usize,
    cuts: Cuts,
    to: Vec<Sender<Message>>,
    from: Vec<Receiver<Message>>,
    pub bytes: usize,
}

/// Returns the halo of each world.
pub fn halos(cuts: Cuts) -> Vec<Threads> {
    let worlds = cuts.worlds();
    let halo = |index| Threads { index, cuts: cuts.clone(), to: Vec::new(), from: Vec::new(), bytes: 0 };
    let mut halos: Vec<Threads> = (0..worlds).map(halo).collect();
    for from in 0..worlds {
        for to in 0..worlds {
            let (send, receive) = channel();
            halos[from].to.push(send);
            halos[to].from.push(receive);
        }
    }
    halos
}

impl Threads {
    /// Sets other cuts.
    pub fn set(&mut self, cuts: Cuts) {
        self.cuts = cuts;
    }

    /// Sends a message to each other world, and returns theirs.
    fn trade(&mut self, mut message: impl FnMut(usize) -> Message) -> Vec<Option<Message>> {
        let others = |index: &usize| *index != self.index;
        for to in (0..self.to.len()).filter(others) {
            self.to[to].send(message(to)).expect("the other world is there");
        }
        (0..self.from.len())
            .map(|from| others(&from).then(|| self.from[from].recv().expect("the other world is there")))
            .collect()
    }
}

impl Halo for Threads {
    fn worlds(&self) -> usize {
        self.to.len()
    }

    fn index(&self) -> usize {
        self.index
    }

    fn owner(&self, place: Vec2) -> usize {
        self.cuts.owner(place)
    }

    fn near(&self, place: Vec2, distance: f32, found: &mut dyn FnMut(usize)) {
        self.cuts.near(place, distance, &mut |world| {
            if world != self.index {
                found(world);
            }
        });
    }

    fn agree(&mut self, own: Agreement) -> Agreement {
        let bytes = postcard::to_stdvec(&own).unwrap();
        let mut all = own;
        for message in self.trade(|_| Message::Agreement(bytes.clone())).into_iter().flatten() {
            let Message::Agreement(bytes) = message else { panic!("the worlds are out of step") };
            all.merge(&postcard::from_bytes(&bytes).unwrap());
        }
        all
    }

    fn exchange(&mut self, mut packets: Vec<Vec<u8>>) -> Vec<Vec<u8>> {
        assert_eq!(packets.len(), self.worlds());
        assert!(packets[self.index].is_empty(), "a packet to itself");
        self.bytes += packets.iter().map(Vec::len).sum::<usize>();
        let packet = |message: Option<Message>| match message {
            None => Vec::new(),
            Some(Message::Packet(packet)) => packet,
            Some(Message::Agreement(_)) => panic!("the worlds are out of step"),
        };
        self.trade(|to| Message::Packet(std::mem::take(&mut packets[to]))).into_iter().map(packet).collect()
    }
}

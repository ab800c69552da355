//! The ranks of an MPI job as the worlds of a division.

use glam::Vec2;
use mpi::datatype::Equivalence;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Destination, Root, Source};
use std::time::{Duration, Instant};
use throng::halo::{Agreement, Cuts, Halo};

/// Greatest length of a message, bytes: MPI counts in 32 bits. In debug builds it is short, so that tests send packets in
/// several messages.
const MOST: usize = if cfg!(debug_assertions) { 1 << 12 } else { 1 << 30 };

/// The ranks of a job, the division of the ground among them, and the time spent in exchanges.
pub struct Ranks {
    all: SimpleCommunicator,
    /// The division of the ground.
    pub cuts: Cuts,
    /// Time spent in exchanges and in waiting for other ranks.
    pub waited: Duration,
    /// Bytes sent to other ranks in exchanges.
    pub sent: u64,
}

impl Ranks {
    /// Returns the ranks of a communicator, with all ground owned by the first.
    pub fn new(all: SimpleCommunicator) -> Self {
        Self { all, cuts: Cuts::default(), waited: Duration::ZERO, sent: 0 }
    }

    /// Returns the number of ranks.
    pub fn count(&self) -> usize {
        self.all.size() as usize
    }

    /// Returns the rank of this process.
    pub fn rank(&self) -> usize {
        self.all.rank() as usize
    }

    /// Whether this process reports to the user.
    pub fn is_first(&self) -> bool {
        self.rank() == 0
    }

    /// Returns the number of ranks on this machine.
    pub fn on_this_machine(&self) -> usize {
        self.all.split_shared(self.all.rank()).size() as usize
    }

    /// Returns a value of each rank.
    pub fn gather<T: Equivalence + Copy + Default>(&self, own: T) -> Vec<T> {
        let mut all = vec![T::default(); self.count()];
        self.all.all_gather_into(&own, &mut all[..]);
        all
    }

    /// Returns which of these flags, at most 64, are set on any rank.
    pub fn any<const N: usize>(&self, own: [bool; N]) -> [bool; N] {
        let bits = own.iter().rev().fold(0u64, |bits, &flag| bits << 1 | u64::from(flag));
        let all = self.gather(bits).into_iter().fold(0, |all, bits| all | bits);
        std::array::from_fn(|index| all >> index & 1 == 1)
    }

    /// Returns the bytes that the first rank has.
    pub fn bytes_of_first(&self, mut bytes: Vec<u8>) -> Vec<u8> {
        let first = self.all.process_at_rank(0);
        let mut length = bytes.len() as u64;
        first.broadcast_into(&mut length);
        bytes.resize(length as usize, 0);
        first.broadcast_into(&mut bytes[..]);
        bytes
    }

    fn receive(&self, rank: usize) -> Vec<u8> {
        self.all.process_at_rank(rank as i32).receive_vec().0
    }

    /// Merges agreements along a binomial tree to the first rank, and returns the result from there.
    fn merge(&self, mut own: Agreement) -> Agreement {
        let (rank, count) = (self.rank(), self.count());
        let mut distance = 1;
        while distance < count {
            if rank & distance != 0 {
                let bytes = encode(&own);
                self.all.process_at_rank((rank - distance) as i32).send(&bytes[..]);
                break;
            }
            if rank + distance < count {
                own.merge(&decode(&self.receive(rank + distance)));
            }
            distance *= 2;
        }
        let bytes = if self.is_first() { encode(&own) } else { Vec::new() };
        decode(&self.bytes_of_first(bytes))
    }

    /// Sends each rank its packet, and returns those of all ranks to this one. Empty packets are not sent.
    fn trade(&self, packets: &[Vec<u8>]) -> Vec<Vec<u8>> {
        let lengths: Vec<u64> = packets.iter().map(|packet| packet.len() as u64).collect();
        let mut coming = vec![0u64; packets.len()];
        self.all.all_to_all_into(&lengths[..], &mut coming[..]);
        let mut received: Vec<Vec<u8>> = coming.iter().map(|&length| vec![0; length as usize]).collect();
        let pieces = |packet: &Vec<u8>| packet.len().div_ceil(MOST);
        let requests = packets.iter().chain(&received).map(pieces).sum();
        mpi::request::multiple_scope(requests, |scope, open| {
            // messages from one rank to another arrive in their order
            for (rank, packet) in received.iter_mut().enumerate() {
                for piece in packet.chunks_mut(MOST) {
                    open.add(self.all.process_at_rank(rank as i32).immediate_receive_into(scope, piece));
                }
            }
            for (rank, packet) in packets.iter().enumerate() {
                for piece in packet.chunks(MOST) {
                    open.add(self.all.process_at_rank(rank as i32).immediate_send(scope, piece));
                }
            }
            open.wait_all(&mut Vec::with_capacity(requests));
        });
        received
    }
}

impl Halo for Ranks {
    fn worlds(&self) -> usize {
        self.count()
    }

    fn index(&self) -> usize {
        self.rank()
    }

    fn owner(&self, place: Vec2) -> usize {
        self.cuts.owner(place)
    }

    fn near(&self, place: Vec2, distance: f32, found: &mut dyn FnMut(usize)) {
        let own = self.rank();
        self.cuts.near(place, distance, &mut |rank| {
            if rank != own {
                found(rank);
            }
        });
    }

    fn agree(&mut self, own: Agreement) -> Agreement {
        let start = Instant::now();
        let all = self.merge(own);
        self.waited += start.elapsed();
        all
    }

    fn exchange(&mut self, packets: Vec<Vec<u8>>) -> Vec<Vec<u8>> {
        let start = Instant::now();
        self.sent += packets.iter().map(|packet| packet.len() as u64).sum::<u64>();
        let received = self.trade(&packets);
        self.waited += start.elapsed();
        received
    }
}

fn encode(value: &Agreement) -> Vec<u8> {
    // writing to memory cannot fail
    postcard::to_stdvec(value).unwrap_or_default()
}

fn decode(bytes: &[u8]) -> Agreement {
    postcard::from_bytes(bytes).expect("MPI has changed a message")
}

(** * spike-lorentzian: A Lorentzian spike of extinction with wide wings

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  100 / (1 + (100 * s - 37) ^ 2).
Definition emission (s : R) : R :=
  1 + (atan (100 * s - 37) + atan 37) ^ 2.
Definition exact_depth (lambda : R) : R :=
  atan (100 * lambda - 37) + atan 37.
Definition exact_radiance (lambda : R) : R :=
  3 - (3 + 2 * (atan (100 * lambda - 37) + atan 37) + (atan (100 * lambda - 37) + atan 37) ^ 2) * exp (- (atan (100 * lambda - 37) + atan 37)).

Theorem spike_lorentzian (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.

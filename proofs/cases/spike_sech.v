(** * spike-sech: A spike of extinction in elementary functions

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  100 / cosh (100 * s - 40) ^ 2.
Definition emission (s : R) : R :=
  2 + tanh (100 * s - 40).
Definition exact_depth (lambda : R) : R :=
  tanh (100 * lambda - 40) + tanh 40.
Definition exact_radiance (lambda : R) : R :=
  3 - tanh 40 - (3 + tanh (100 * lambda - 40)) * exp (- tanh (100 * lambda - 40) - tanh 40).

Theorem spike_sech (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
